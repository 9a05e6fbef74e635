// SPDX-License-Identifier: BSD-3-Clause
// A .vtu or .pvtu file: read, then checked and assembled as `check` and `repartition` do.
#include <algorithm>
#include <filesystem>

#include "tessera/base/error.hpp"
#include "tessera/check/check_mesh.hpp"
#include "tessera/check/report.hpp"
#include "tessera/comm/environment.hpp"
#include "tessera/io/vtu.hpp"
#include "tessera/migrate/assemble.hpp"

#include "support/temporary_file.hpp"

#include "fuzz_target.hpp"

namespace tessera {
namespace {

using mesh::MeshArrays;

template <class Arrays>
void promise_sizes(const Arrays& arrays, GlobalIndex size)
{
  for (const auto& [name, values] : arrays) fuzz::promise(std::ssize(values) == size);
}

void promise_consistent(const MeshArrays& mesh)
{
  fuzz::promise(mesh.point_xyz.size() % 3 == 0);
  fuzz::promise(std::ssize(mesh.cell_points) == mesh.num_cells() * mesh.vertices_per_cell);
  fuzz::promise(std::ranges::all_of(mesh.cell_points, [&](GlobalIndex point) {
    return point >= 0 && point < mesh.num_points();
  }));
  fuzz::promise(mesh.point_ids.empty() || std::ssize(mesh.point_ids) == mesh.num_points());
  fuzz::promise(mesh.cell_ids.empty() || std::ssize(mesh.cell_ids) == mesh.num_cells());
  promise_sizes(mesh.point_ints, mesh.num_points());
  promise_sizes(mesh.cell_ints, mesh.num_cells());
  promise_sizes(mesh.cell_longs, mesh.num_cells());
  promise_sizes(mesh.cell_doubles, mesh.num_cells());
}

void check(const MeshArrays& mesh, const comm::Communicator& comm)
{
  const check::PieceSource source{1, [&](LocalIndex) { return mesh; }};
  static_cast<void>(check::to_json(check::check_mesh(source, nullptr, comm)));
  static_cast<void>(check::check_mesh(source, &source, comm, {.is_partial = true}));
}

void read(const std::filesystem::path& path, const comm::Communicator& comm)
{
  for (const std::filesystem::path& file : io::piece_files(path)) {
    const MeshArrays mesh = io::read_vtu(file);
    promise_consistent(mesh);
    check(mesh, comm);
    if (mesh.vertices_per_cell != 4) continue;
    static_cast<void>(migrate::assemble(comm, {.tets = {mesh}}));
  }
}

// From the first input to the end of the process.
comm::Communicator world()
{
  static int argc = 0;
  static char** argv = nullptr;
  static const comm::Environment environment(argc, argv);
  return comm::world();
}

}  // namespace
}  // namespace tessera

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  static const tessera::comm::Communicator comm = tessera::world();
  const tessera::testing::TemporaryFile file("mesh", tessera::fuzz::text_of(data, size));
  try {
    tessera::read(file.path(), comm);
  } catch (const tessera::InputError&) {
  }
  return 0;
}
