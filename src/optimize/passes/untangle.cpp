// SPDX-License-Identifier: BSD-3-Clause
#include "optimize/passes/untangle.hpp"

#include <algorithm>
#include <cstdint>
#include <vector>

#include "optimize/passes/passes.hpp"
#include "optimize/star_energy.hpp"
#include "optimize/tet_energy.hpp"

namespace tessera::optimize {
namespace {

constexpr int kRounds = 12;
constexpr int kSweeps = 4;           // A round.
constexpr double kFirstShare = 0.3;  // See sweep(); halved from round to round.

// Below this mean ratio a tet's vertices are moved: with the inverted ones those that are squeezed
// by them.
constexpr double kBadMeanRatio = 0.2;

// Swaps and collapses for bad tets only, whatever else they cost.
const Schedule kRescue{.swap_below = kBadMeanRatio,
                       .try_all_below = kBadMeanRatio,
                       .collapse_below = 1e-3,
                       .collapse_reach = 2.0};

std::vector<std::uint8_t> vertices_of_bad_tets(const WorkingMesh& mesh)
{
  const double good = energy_of_mean_ratio(kBadMeanRatio);
  std::vector<std::uint8_t> flags(mesh.points.size(), 0);
  for (Corner corner = 0; corner < 4 * mesh.num_slots(); ++corner) {
    if (mesh.is_free_slot(tet_of(corner)) || mesh.tet_energy[at(tet_of(corner))] < good) continue;
    flags[at(mesh.tet_vertices[at(corner)])] = 1;
  }
  return flags;
}

void gather(const WorkingMesh& mesh, LocalIndex v, StarEnergy& star)
{
  star.clear();
  for (LocalIndex i = mesh.star_offsets[at(v)]; i < mesh.star_offsets[at(v) + 1]; ++i) {
    const auto [a, b, c] = face_vertices(mesh.tet_vertices, mesh.star_corners[at(i)]);
    star.add_face(to_vec3(mesh.points[at(a)]), to_vec3(mesh.points[at(b)]),
                  to_vec3(mesh.points[at(c)]));
  }
}

// One pass over the vertices of bad tets. `share`: delta by the volume of a regular tet.
void sweep(WorkingMesh& mesh, double share)
{
  refresh_stars(mesh);
  StarEnergy star;
  const std::vector<std::uint8_t> is_bad = vertices_of_bad_tets(mesh);
  for (LocalIndex v = 0; v < mesh.num_vertices(); ++v) {
    if (is_bad[at(v)] == 0 || mesh.vertex_fixed[at(v)] != 0) continue;
    gather(mesh, v, star);
    const Vec3 old = to_vec3(mesh.points[at(v)]);
    const Vec3 now = star.minimize(old, share * star.typical_volume(old), 2);
    mesh.points[at(v)] = {now[0], now[1], now[2], 0.0};
  }
  mesh.are_energies_stale = true;
  refresh_energies(mesh);
}

void sweep_until_positive(WorkingMesh& mesh, double share)
{
  for (int i = 0; i < kSweeps && count_not_positive(mesh) > 0; ++i) sweep(mesh, share);
}

void mark_all(WorkingMesh& mesh)
{
  std::fill(mesh.tet_to_swap.begin(), mesh.tet_to_swap.end(), 1);
  std::fill(mesh.vertex_to_collapse.begin(), mesh.vertex_to_collapse.end(), 1);
}

}  // namespace

void untangle(WorkingMesh& mesh)
{
  refresh_energies(mesh);
  mesh.worst_energy = kHighestEnergy;
  double share = kFirstShare;
  for (int round = 0; round < kRounds && count_not_positive(mesh) > 0; ++round) {
    sweep_until_positive(mesh, share);
    mark_all(mesh);
    swap_pass(mesh, kRescue);
    // Moving and swapping have had their chance.
    if (round >= kRounds / 2) collapse_pass(mesh, kRescue);
    share *= 0.5;
  }
  mark_all(mesh);
}

void untangle_by_moving(WorkingMesh& mesh)
{
  refresh_energies(mesh);
  double share = kFirstShare;
  for (int round = 0; round < kRounds && count_not_positive(mesh) > 0; ++round) {
    sweep_until_positive(mesh, share);
    share *= 0.5;
  }
}

}  // namespace tessera::optimize
