// SPDX-License-Identifier: BSD-3-Clause
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "optimize/passes/passes.hpp"
#include "optimize/tet_energy.hpp"

namespace tessera::optimize {
namespace {

// What lies around vertices that moved has changed. A streaming pass, since flags that were set
// where positions are written would keep the compiler from holding those in registers.
void mark_changes(WorkingMesh& mesh, const std::vector<std::uint8_t>& has_moved)
{
  for (LocalIndex t = 0; t < mesh.num_slots(); ++t) {
    if (mesh.is_free_slot(t)) continue;
    const LocalIndex* v = &mesh.tet_vertices[4 * at(t)];
    if ((has_moved[at(v[0])] | has_moved[at(v[1])] | has_moved[at(v[2])] | has_moved[at(v[3])])
        == 0) {
      continue;
    }
    mesh.tet_to_swap[at(t)] = 1;
    for (std::size_t c = 0; c < 4; ++c) {
      mesh.vertex_to_smooth[at(v[c])] = 1;
      mesh.vertex_to_collapse[at(v[c])] = 1;
    }
  }
}

// Smooths the vertices flagged in `to_smooth`.
void smooth(WorkingMesh& mesh, const std::vector<std::uint8_t>& to_smooth,
            LocalIndex (*kernel)(const SmoothTask&))
{
  refresh_stars(mesh);
  std::vector<std::uint8_t> has_moved(mesh.points.size(), 0);
  mesh.statistics.num_moves += kernel({.stars = mesh.stars(),
                                       .points = mesh.points.data(),
                                       .num_vertices = mesh.num_vertices(),
                                       .vertex_fixed = mesh.vertex_fixed.data(),
                                       .vertex_to_smooth = to_smooth.data(),
                                       .has_moved = has_moved.data(),
                                       .worst_energy = mesh.worst_energy});
  mark_changes(mesh, has_moved);
  mesh.are_energies_stale = true;
}

std::vector<std::uint8_t> vertices_of_tets_above(const WorkingMesh& mesh, double energy)
{
  std::vector<std::uint8_t> flags(mesh.points.size(), 0);
  for (LocalIndex t = 0; t < mesh.num_slots(); ++t) {
    if (mesh.is_free_slot(t) || mesh.tet_energy[at(t)] <= energy) continue;
    for (std::size_t c = 0; c < 4; ++c) flags[at(mesh.tet_vertices[4 * at(t) + c])] = 1;
  }
  return flags;
}

}  // namespace

void smooth_pass(WorkingMesh& mesh)
{
  std::vector<std::uint8_t> to_smooth(mesh.points.size(), 0);
  to_smooth.swap(mesh.vertex_to_smooth);
  smooth(mesh, to_smooth, mesh.kernels->smooth);
}

void smooth_worst_pass(WorkingMesh& mesh, const Schedule& schedule)
{
  refresh_energies(mesh);
  smooth(mesh, vertices_of_tets_above(mesh, energy_of_mean_ratio(schedule.worst_below)),
         mesh.kernels->smooth_worst);
}

}  // namespace tessera::optimize
