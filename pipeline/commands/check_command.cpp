// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/commands/check_command.hpp"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <vector>

#include <fmt/format.h>
#include <malloc.h>

#include "tessera/base/error.hpp"
#include "tessera/check/check_mesh.hpp"
#include "tessera/comm/all_or_none.hpp"
#include "tessera/io/vtu.hpp"
#include "tessera/subdomain/mesh_input.hpp"

#include "pipeline/runtime/stop_signal.hpp"

namespace tessera::pipeline {
namespace {

using Files = std::vector<std::filesystem::path>;

check::PieceSource source_of(const Files& files, io::CellOrder order = io::CellOrder::up_to_second)
{
  return {static_cast<LocalIndex>(files.size()), [&files, order](LocalIndex piece) {
            throw_if_stop_requested();
            return io::read_vtu(files[static_cast<std::size_t>(piece)], order);
          }};
}

// Files of one piece have one name.
std::vector<LocalIndex> pieces_of_lines(const Files& lines, const Files& tets)
{
  std::vector<LocalIndex> pieces;
  for (const std::filesystem::path& file : lines) {
    const auto same = std::ranges::find(tets, file.filename(), &std::filesystem::path::filename);
    if (same == tets.end()) {
      throw comm::Collective<InputError>(
          fmt::format("{}: the mesh has no piece {} that it belongs to", file.string(),
                      file.filename().string()));
    }
    pieces.push_back(static_cast<LocalIndex>(same - tets.begin()));
  }
  return pieces;
}

// Large blocks are mapped, so that what a piece needs while it is read goes back at once. By itself
// malloc maps fewer and fewer of them: then little stays of every piece, with holes in between that
// take as much. Costs a tenth of the time.
void map_large_blocks()
{
  constexpr int kLeastBytes = 1 << 20;
  ::mallopt(M_MMAP_THRESHOLD, kLeastBytes);
}

void print(const check::CheckReport& report)
{
  fmt::print(
      "{} tets, {} vertices, {} boundary triangles, {} between subdomains, {} between "
      "materials\n",
      report.num_tets, report.num_vertices, report.num_boundary_triangles,
      report.num_seam_triangles, report.num_interface_triangles);
  if (report.is_partial)
    fmt::print("partial check: {} open seam triangles, holes in the ids allowed\n",
               report.num_open_seam_triangles);
  fmt::print("volume {:.10g}, boundary area {:.10g}\n", report.volume, report.boundary_area);
  fmt::print("Euler characteristic {}, components {}, boundary components {}\n",
             report.euler_characteristic, report.num_components, report.num_boundary_components);
  fmt::print("dihedral angles {:.2f} to {:.2f} deg, mean ratio: smallest {:.4f}, mean {:.4f}\n",
             report.quality.min_dihedral_deg, report.quality.max_dihedral_deg,
             report.quality.mean_ratio_min, report.quality.mean_ratio_mean);
  if (report.order == 2)
    fmt::print("second order: smallest scaled Jacobian at least {:.4f}\n",
               report.scaled_jacobian_min);
  if (report.has_digest) fmt::print("digest {}\n", to_hex(report.digest));
  for (const std::string& note : report.notes) fmt::print("note: {}\n", note);
  for (const check::Defect& defect : report.defects) {
    fmt::print("DEFECT {}: {} times\n", defect.kind, defect.count);
    for (const std::string& offender : defect.offenders) fmt::print("  {}\n", offender);
  }
  const char* const what = report.is_partial ? "the part of the mesh" : "the mesh";
  fmt::print("{} {}\n", what, report.conforms ? "conforms" : "does NOT conform");
}

}  // namespace

ExitCode run_check_command(const CheckCommand& command, const comm::Communicator& comm)
{
  map_large_blocks();
  const auto mesh_files = subdomain::pieces_of(command.mesh_file, comm);
  const check::PieceSource mesh = source_of(mesh_files);
  const auto boundary_files = subdomain::pieces_beside(command.mesh_file, "boundary.pvtu", comm);
  std::optional<check::PieceSource> boundary;
  if (boundary_files) boundary = source_of(*boundary_files);
  check::CheckReport report =
      check::check_mesh(mesh, boundary ? &*boundary : nullptr, comm, {command.is_partial});
  if (const auto line_files = subdomain::pieces_beside(command.mesh_file, "lines.pvtu", comm)) {
    check::check_lines(mesh, source_of(*line_files, io::CellOrder::edges),
                       pieces_of_lines(*line_files, mesh_files), comm, report);
  }
  if (comm.rank() == 0) {
    if (command.json) {
      std::fputs((check::to_json(report) + "\n").c_str(), stdout);
    } else {
      print(report);
    }
  }
  return report.conforms ? ExitCode::ok : ExitCode::failed;
}

}  // namespace tessera::pipeline
