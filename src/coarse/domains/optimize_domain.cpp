// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/coarse/optimize_domain.hpp"

#include <utility>

#include "tessera/base/repair.hpp"
#include "tessera/optimize/optimize.hpp"

namespace tessera::coarse {
namespace {

surface::DomainTets optimized(surface::DomainTets tets, const optimize::Schedule& schedule)
{
  optimize::OptimizeResult better = optimize::optimize(
      {.vertex_xyz = std::move(tets.vertex_xyz), .tet_vertices = std::move(tets.tet_vertices)},
      schedule);
  note_repair(Repair::worst_tets, better.statistics.num_insertions);
  return {std::move(better.vertex_xyz), std::move(better.tet_vertices)};
}

}  // namespace

surface::DomainTets optimize_domain(surface::DomainTets tets)
{
  const optimize::Schedule schedule{
      .steps = optimize::parse_steps("msmscmscmscmscwtsmmmwwtsmmmwww"),
      .collapse_below = 0.85,
      .collapse_reach = 0.95};
  return optimized(std::move(tets), schedule);
}

surface::DomainTets smooth_domain(surface::DomainTets tets)
{
  return optimized(std::move(tets), {.steps = optimize::parse_steps("tmmww")});
}

surface::DomainTets mend_domain(surface::DomainTets tets)
{
  if (is_left_out(Repair::worst_tets)) return tets;
  return optimized(std::move(tets),
                   {.steps = optimize::parse_steps("iwwiwwiww"), .insert_below = 0.35});
}

}  // namespace tessera::coarse
