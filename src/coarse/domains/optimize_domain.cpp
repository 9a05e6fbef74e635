// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/coarse/optimize_domain.hpp"

#include <string>
#include <string_view>
#include <utility>

#include "tessera/base/repair.hpp"
#include "tessera/optimize/optimize.hpp"

namespace tessera::coarse {
namespace {

constexpr std::string_view kSteps = "msdmscmscmscmscwtsmmmwwtsmmmwww";

// Vertices put into the worst tets: their corners are all on the skin, as across a thin wall, so
// neither moves nor swaps help.
constexpr std::string_view kStepsOfWorst = "tiwwiwwiww";

}  // namespace

surface::DomainTets optimize_domain(const surface::DomainSkin& skin, surface::DomainTets tets)
{
  optimize::TetMesh mesh{.vertex_xyz = std::move(tets.vertex_xyz),
                         .tet_vertices = std::move(tets.tet_vertices)};
  if (!is_left_out(Repair::illegal_tets)) {
    mesh.outer_triangles = skin.triangle_vertices;
    mesh.outer_group = skin.triangle_patch;
  }
  std::string steps(kSteps);
  if (!is_left_out(Repair::worst_tets)) steps += kStepsOfWorst;
  optimize::OptimizeResult better = optimize::optimize(mesh, {.steps = optimize::parse_steps(steps),
                                                              .collapse_below = 0.85,
                                                              .collapse_reach = 0.95,
                                                              .insert_below = 0.35});
  note_repair(Repair::illegal_tets, better.statistics.num_divided);
  note_repair(Repair::worst_tets, better.statistics.num_insertions);
  return {std::move(better.vertex_xyz), std::move(better.tet_vertices)};
}

}  // namespace tessera::coarse
