// SPDX-License-Identifier: BSD-3-Clause
#include "support/periodic_box.hpp"

#include <filesystem>

#include "tessera/io/vtu.hpp"
#include "tessera/mesh/periodic_pairs.hpp"

namespace tessera::testing {
namespace {

namespace fs = std::filesystem;

const std::vector<std::string> kPatchNames{"left", "right", "front", "back", "rest"};

// By x, then by y.
std::int32_t patch_of(const mesh::MeshArrays& triangles, std::size_t first)
{
  for (std::int32_t patch = 0; patch < 4; ++patch) {
    const auto d = static_cast<std::size_t>(patch / 2);
    bool is_on = true;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto point = static_cast<std::size_t>(triangles.cell_points[first + i]);
      if (triangles.point_xyz[3 * point + d] != patch % 2) is_on = false;
    }
    if (is_on) return patch;
  }
  return 4;
}

}  // namespace

void write_periodic_box(const SharedFolder& folder, const std::vector<std::string>& pairs,
                        const comm::Communicator& comm)
{
  if (comm.rank() == 0) {
    fs::create_directories(folder / "mesh");
    fs::create_directories(folder / "boundary");
    std::vector<fs::path> files;
    std::vector<fs::path> boundary;
    mesh::MeshArrays tets;
    mesh::MeshArrays triangles;
    for (LocalIndex p = 0; p < kPeriodicBox.num_pieces(); ++p) {
      const std::string name = "piece_" + std::to_string(p) + ".vtu";
      tets = kPeriodicBox.tets(p);
      tets.field_texts = {{"patch_names", kPatchNames}, {mesh::kPeriodicPairsName, pairs}};
      triangles = kPeriodicBox.boundary(p);
      for (std::size_t i = 0; i < triangles.cell_ints["patch"].size(); ++i)
        triangles.cell_ints["patch"][i] = patch_of(triangles, 3 * i);
      files.push_back(fs::path("mesh") / name);
      boundary.push_back(fs::path("boundary") / name);
      io::write_vtu(tets, folder / files.back(), io::Compression::none);
      io::write_vtu(triangles, folder / boundary.back(), io::Compression::none);
    }
    io::write_pvtu(folder / "mesh.pvtu", files, tets);
    io::write_pvtu(folder / "boundary.pvtu", boundary, triangles);
  }
  comm.barrier();
}

}  // namespace tessera::testing
