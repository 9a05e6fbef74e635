// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/coarse/optimize_domain.hpp"

#include <utility>

#include "tessera/base/repair.hpp"
#include "tessera/optimize/optimize.hpp"

namespace tessera::coarse {
namespace {

DomainTets optimized(DomainTets tets, const optimize::Schedule& schedule)
{
  optimize::OptimizeResult better = optimize::optimize(
      {.vertex_xyz = std::move(tets.vertex_xyz), .tet_vertices = std::move(tets.tet_vertices)},
      schedule);
  note_repair(Repair::worst_tets, better.statistics.num_insertions);
  return {std::move(better.vertex_xyz), std::move(better.tet_vertices)};
}

}  // namespace

DomainTets optimize_domain(DomainTets tets)
{
  const optimize::Schedule schedule{
      .steps = optimize::parse_steps("msmscmscmscmscwtsmmmwwtsmmmwww"),
      .collapse_below = 0.85,
      .collapse_reach = 0.95};
  return optimized(std::move(tets), schedule);
}

DomainTets smooth_domain(DomainTets tets)
{
  return optimized(std::move(tets), {.steps = optimize::parse_steps("tmmww")});
}

DomainTets mend_domain(DomainTets tets)
{
  if (is_left_out(Repair::worst_tets)) return tets;
  return optimized(std::move(tets),
                   {.steps = optimize::parse_steps("iwwiwwiww"), .insert_below = 0.35});
}

}  // namespace tessera::coarse
