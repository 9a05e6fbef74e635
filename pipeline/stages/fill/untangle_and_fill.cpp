// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/stages/fill/untangle_and_fill.hpp"

#include <algorithm>
#include <iterator>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "tessera/base/error.hpp"
#include "tessera/comm/all_or_none.hpp"

#include "pipeline/jobs/for_each_dynamic.hpp"
#include "pipeline/stages/fill/fill_stage.hpp"
#include "pipeline/stages/fill/load_stage.hpp"
#include "pipeline/stages/fill/untangle_stage.hpp"

namespace tessera::pipeline {
namespace {

// The plan that a stopped run has left, or a first one.
Plan first_plan(const UntangleAndFillWork& work, RunContext& context)
{
  auto kept = comm::on_root(
      context.comm, [&] { return work.state == nullptr ? std::nullopt : work.state->find_plan(); });
  if (kept) return *std::move(kept);
  Plan plan{.kernels = work.kernels};
  plan.limiter = run_untangle_stage({.cut = work.cut,
                                     .kernels = plan.kernels,
                                     .subdomains = in_order(at(work.cut.num_subdomains()))},
                                    {}, context);
  return plan;
}

// Makes the plan anew for subdomains that were folded under it.
Plan plan_for_folded(const Plan& before, const FilledPieces& filled,
                     const subdomain::PartitionedMesh& cut, RunContext& context)
{
  Plan plan = with_folded_subdivided(before, filled);
  UntangleWork work{.cut = cut, .kernels = plan.kernels, .depth = UntangleDepth::all_levels};
  for (const FoldedSubdomain& one : filled.folded) work.subdomains.push_back(one.subdomain);
  plan.limiter = run_untangle_stage(work, std::move(plan.limiter), context);
  all_or_none(context.comm, [&] {
    if (!lead_to_the_same_fills(plan, before)) return;
    throw MeshError(
        fmt::format("subdomain {} has coarse tets that are too flat to be subdivided; try another "
                    "coarse.max_size",
                    filled.folded.front().subdomain));
  });
  return plan;
}

}  // namespace

// A round either changes a kernel to subdivision, or lowers a limit, or is the last: so it ends.
LimitedPieces untangle_and_fill(const config::Case& run_case, const UntangleAndFillWork& work,
                                RunContext& context)
{
  Plan plan = first_plan(work, context);
  LimitedPieces result;
  for (;;) {
    all_or_none(context.comm, [&] {
      if (work.state != nullptr && context.comm.rank() == 0) work.state->keep_plan(plan);
    });
    load_limiter(plan.limiter, context);
    result.filled = run_fill_stage(
        run_case, {work.cut, work.kernels, plan.kernels, plan.limiter, work.ranges}, context);
    if (result.filled.folded.empty()) break;
    plan = plan_for_folded(plan, result.filled, work.cut, context);
  }
  for (subdomain::PieceSummary& piece : result.filled.pieces) {
    if (std::ranges::binary_search(plan.limited, piece.subdomain)) piece.was_limited = true;
  }
  std::ranges::move(plan.failures, std::back_inserter(result.filled.failures));
  result.limiter = std::move(plan.limiter);
  return result;
}

Plan with_folded_subdivided(Plan plan, const FilledPieces& filled)
{
  std::vector<LocalIndex> folded;
  for (const FoldedSubdomain& one : filled.folded) {
    plan.kernels[at(one.subdomain)] = fill::KernelKind::subdivide;
    if (one.was_limited) plan.limited.push_back(one.subdomain);
    folded.push_back(one.subdomain);
  }
  std::ranges::sort(plan.limited);
  std::ranges::copy_if(filled.failures, std::back_inserter(plan.failures), [&](const auto& tries) {
    return std::ranges::binary_search(folded, tries.subdomain);
  });
  return plan;
}

bool lead_to_the_same_fills(const Plan& a, const Plan& b)
{
  return a.kernels == b.kernels && a.limiter == b.limiter;
}

}  // namespace tessera::pipeline
