// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/stages/coarse_try.hpp"

#include <algorithm>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "tessera/coarse/coarse_surface.hpp"
#include "tessera/comm/all_or_none.hpp"

#include "pipeline/jobs/failed_jobs.hpp"
#include "pipeline/jobs/for_each_dynamic.hpp"
#include "pipeline/stages/coarse_budget.hpp"

namespace tessera::pipeline {
namespace {

// Runs a job and reads its result; nothing if it failed, and then `outcome` says why. What this
// process has noted afterwards are the repairs of the job.
template <class Result>
std::optional<Result> result_of(const JobRequest& job, const jobs::JobRunner::WaitCallback& on_wait,
                                jobs::JobOutcome& outcome, RunContext& context)
{
  static_cast<void>(take_noted_repairs());
  outcome = run_job(job, on_wait, context);
  auto result = read_result(outcome, from_bytes<Result>);
  keep_if_failed(job, outcome, context);
  throw_if_cancelled(outcome);
  context.log.debug("{}: {:.2f} of {:.0f} s of CPU time", job.name, outcome.cpu_s,
                    job.limits.cpu_s);
  outcome.result.clear();
  return result;
}

struct Division {
  coarse::DividedSurface divided{};
  bool was_limited = false;  // It failed for lack of time or memory.

  static auto fields(auto& self) { return std::tie(self.divided, self.was_limited); }
};

// The surface in pieces, if a domain is large. What cannot be divided is filled as it is.
Division divide(const coarse::CoarseSurface& surface, const CoarsePlan& plan, RunContext& context)
{
  return comm::on_root(context.comm, [&] {
    if (!coarse::has_large_domain(surface)) return Division{coarse::undivided(surface)};
    jobs::JobOutcome outcome;
    double num_tets = 0.0;
    for (LocalIndex domain = 1; domain <= surface.num_domains(); ++domain) {
      num_tets += coarse::predicted_tets(coarse::skin_of(surface, domain));
    }
    const jobs::JobLimits limits = whole_limits(plan.options, num_tets);
    const Bytes request = coarse_divide_request(surface, plan.options);
    auto divided = result_of<coarse::DividedSurface>({"coarse: divide", request, limits},
                                                     wait_for_stop_signal(), outcome, context);
    if (!divided) context.log.warn("coarse: {}; domains are filled whole", outcome.message);
    if (!divided) return Division{coarse::undivided(surface), depends_on_machine(outcome)};
    if (divided->surface.num_domains() > surface.num_domains()) {
      context.log.info("coarse: {} domains in {} pieces", surface.num_domains(),
                       divided->surface.num_domains());
    }
    return Division{std::move(*divided)};
  });
}

struct FailedPiece {
  LocalIndex piece = 0;
  jobs::JobOutcome outcome{};

  static auto fields(auto& self) { return std::tie(self.piece, self.outcome); }
};

// What this rank made of the pieces of a surface.
struct PieceShare {
  std::vector<FilledPiece> filled{};
  RepairCounts repairs{};
  std::vector<FailedPiece> failed{};
};

std::vector<double> triangles_of_pieces(const coarse::CoarseSurface& surface)
{
  std::vector<double> num_triangles(at(surface.num_domains()));
  for (const auto& domains : surface.face_domains) {
    for (const LocalIndex domain : domains) {
      if (domain > 0) num_triangles[at(domain - 1)] += 1.0;
    }
  }
  return num_triangles;
}

PieceShare fill_share(const coarse::DividedSurface& divided, const coarse::CoarseOptions& options,
                      StageScope& stage, RunContext& context)
{
  PieceShare share;
  const auto fill = [&](LocalIndex item, const jobs::JobRunner::WaitCallback& on_wait) {
    const LocalIndex piece = item + 1;
    coarse::DomainSkin skin = coarse::skin_of_piece(divided, piece);
    const jobs::JobLimits limits = domain_limits(options, skin);
    const Bytes request = coarse_piece_request(std::move(skin), options);
    jobs::JobOutcome outcome;
    auto tets = result_of<coarse::DomainTets>(
        {fmt::format("coarse: piece {}", piece), request, limits}, on_wait, outcome, context);
    if (tets) {
      share.repairs += take_noted_repairs();
      share.filled.push_back({piece, std::move(*tets)});
    } else {
      share.failed.push_back({piece, std::move(outcome)});
    }
  };
  const std::vector<double> weights = triangles_of_pieces(divided.surface);
  for_each_dynamic(heaviest_first(weights), fill, stage, context);
  return share;
}

// All pieces, on rank 0; or the first that failed, on every rank.
struct PieceTry {
  std::optional<FailedPiece> failed{};
  std::vector<FilledPiece> filled{};
  RepairCounts repairs{};
};

PieceTry fill_pieces(const coarse::DividedSurface& divided, const coarse::CoarseOptions& options,
                     StageScope& stage, RunContext& context)
{
  const PieceShare share = fill_share(divided, options, stage, context);
  auto failed = context.comm.all_gather_rows(share.failed);
  if (!failed.empty())
    return {std::move(*std::ranges::min_element(failed, {}, &FailedPiece::piece)), {}, {}};
  PieceTry all;
  for (const Bytes& bytes : context.comm.gather_to_root(to_bytes(share.repairs))) {
    all.repairs += from_bytes<RepairCounts>(bytes);
  }
  for (const Bytes& bytes : context.comm.gather_to_root(to_bytes(share.filled))) {
    auto some = from_bytes<std::vector<FilledPiece>>(bytes);
    std::ranges::move(some, std::back_inserter(all.filled));
  }
  std::ranges::sort(all.filled, {}, &FilledPiece::piece);
  return all;
}

}  // namespace

SurfaceTry try_coarse_surface(const CoarsePlan& plan, const jobs::JobRunner::WaitCallback& on_wait,
                              RunContext& context)
{
  SurfaceTry made;
  // Gmsh is a child of the job and has the same limit.
  coarse::CoarseOptions options = plan.options;
  options.timeout_s = plan.limits.cpu_s;
  const Bytes request = coarse_surface_request(options, plan.planes, plan.rung);
  made.surface = result_of<coarse::CoarseSurface>({"coarse", request, plan.limits}, on_wait,
                                                  made.outcome, context);
  made.repairs = take_noted_repairs();
  return made;
}

CoarseAttempt fill_coarse_surface(const CoarsePlan& plan, coarse::CoarseSurface surface,
                                  StageScope& stage, RunContext& context)
{
  auto [divided, was_limited] = divide(surface, plan, context);
  PieceTry pieces = fill_pieces(divided, plan.options, stage, context);
  RepairCounts repairs;
  const bool is_divided = divided.surface.num_domains() > surface.num_domains();
  if (pieces.failed && is_divided && !is_left_out(Repair::whole_domains)) {
    repairs.add(Repair::whole_domains);
    context.log.warn("coarse: piece {}: {}; domains are filled whole", pieces.failed->piece,
                     pieces.failed->outcome.message);
    was_limited = was_limited || depends_on_machine(pieces.failed->outcome);
    divided = coarse::undivided(surface);
    pieces = fill_pieces(divided, plan.options, stage, context);
  }
  if (pieces.failed) return {.outcome = std::move(pieces.failed->outcome)};
  repairs += pieces.repairs;
  CoarseAttempt attempt{.repairs = repairs, .was_limited = was_limited};
  attempt.outcome = comm::on_root(context.comm, [&] {
    std::size_t num_tets = surface.mesh.tet_vertices.size() / 4;
    for (const FilledPiece& one : pieces.filled) num_tets += one.tets.tet_vertices.size() / 4;
    const jobs::JobLimits limits = whole_limits(plan.options, static_cast<double>(num_tets));
    const Bytes request = coarse_mesh_request(std::move(surface), std::move(divided),
                                              std::move(pieces.filled), plan.options, plan.planes);
    jobs::JobOutcome outcome;
    attempt.made = result_of<CoarseTry>({"coarse: whole", request, limits}, wait_for_stop_signal(),
                                        outcome, context);
    attempt.repairs += take_noted_repairs();
    return outcome;
  });
  return attempt;
}

}  // namespace tessera::pipeline
