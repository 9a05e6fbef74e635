// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/improve/improve_region.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "improve/make_update.hpp"
#include "improve/owners.hpp"
#include "improve/region_check.hpp"
#include "improve/split_tets.hpp"

namespace tessera::improve {
namespace {

// Worst values that are good enough to let the optimiser trade them for the mean.
constexpr double kGoodDihedralDeg = 15.0;
constexpr double kGoodMeanRatio = 0.4;

std::string from_to(const std::string& what, double before, double after)
{
  return fmt::format("{} would go from {:.4g} to {:.4g}", what, before, after);
}

}  // namespace

std::string refusal(const ShapeSummary& before, const ShapeSummary& after)
{
  if (after.min_dihedral_deg < std::min(before.min_dihedral_deg, kGoodDihedralDeg)) {
    return from_to("the smallest dihedral angle", before.min_dihedral_deg, after.min_dihedral_deg);
  }
  if (after.min_mean_ratio < std::min(before.min_mean_ratio, kGoodMeanRatio)) {
    return from_to("the smallest mean ratio", before.min_mean_ratio, after.min_mean_ratio);
  }
  if (!(after.mean_mean_ratio > before.mean_mean_ratio)) {
    return from_to("the mean of the mean ratio", before.mean_mean_ratio, after.mean_mean_ratio);
  }
  return {};
}

RegionOutcome improve_region(const RegionMesh& mesh, const Optimizer& optimizer, int rounds,
                             const MeasureShapes& measure)
{
  const TetMesh old{mesh.vertex_xyz, mesh.tet_vertices};
  TetMesh tets = optimizer.optimize(
      {old, mesh.num_fixed(), mesh.triangle_vertices, mesh.triangle_outside}, rounds);
  static_cast<void>(check_tets(mesh, tets));
  RegionOutcome outcome;
  outcome.num_splits = split_disputed(mesh, tets);
  const std::vector<LocalIndex> triangle_tet = check_tets(mesh, tets);
  const std::vector<LocalIndex> owners = give_to_owners(mesh, tets, triangle_tet);
  outcome.before = measure(old);
  outcome.after = measure(tets);
  outcome.reason = refusal(outcome.before, outcome.after);
  outcome.is_accepted = outcome.reason.empty();
  if (outcome.is_accepted) outcome.updates = make_updates(mesh, tets, owners);
  return outcome;
}

}  // namespace tessera::improve
