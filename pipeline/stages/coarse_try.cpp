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

// Runs a job and reads its result; nothing if it failed, and then `outcome` says why.
template <class Result>
std::optional<Result> result_of(const JobRequest& job, const jobs::JobRunner::WaitCallback& on_wait,
                                jobs::JobOutcome& outcome, RunContext& context)
{
  outcome = run_job(job, on_wait, context);
  auto result = read_result(outcome, from_bytes<Result>);
  keep_if_failed(job, outcome, context);
  throw_if_cancelled(outcome);
  context.log.debug("{}: {:.2f} of {:.0f} s of CPU time", job.name, outcome.cpu_s,
                    job.limits.cpu_s);
  outcome.result.clear();
  return result;
}

struct FailedDomain {
  LocalIndex domain = 0;
  jobs::JobOutcome outcome{};

  static auto fields(auto& self) { return std::tie(self.domain, self.outcome); }
};

// What this rank made of the domains of a surface.
struct DomainShare {
  std::vector<FilledDomain> filled{};
  std::vector<FailedDomain> failed{};
};

DomainShare fill_domains(const coarse::CoarseSurface& surface, const coarse::CoarseOptions& options,
                         StageScope& stage, RunContext& context)
{
  DomainShare share;
  std::vector<double> num_triangles(at(surface.num_domains()));
  for (const auto& domains : surface.face_domains) {
    for (const LocalIndex domain : domains) {
      if (domain > 0) num_triangles[at(domain - 1)] += 1.0;
    }
  }
  const auto fill = [&](LocalIndex item, const jobs::JobRunner::WaitCallback& on_wait) {
    const LocalIndex domain = item + 1;
    coarse::DomainSkin skin = coarse::skin_of(surface, domain);
    const jobs::JobLimits limits = domain_limits(options, skin);
    const Bytes request = coarse_domain_request(std::move(skin), options);
    jobs::JobOutcome outcome;
    auto tets = result_of<coarse::DomainTets>(
        {fmt::format("coarse: domain {}", domain), request, limits}, on_wait, outcome, context);
    if (tets) {
      share.filled.push_back({domain, std::move(*tets)});
    } else {
      share.failed.push_back({domain, std::move(outcome)});
    }
  };
  for_each_dynamic(heaviest_first(num_triangles), fill, stage, context);
  return share;
}

std::vector<FilledDomain> gather(const std::vector<FilledDomain>& filled,
                                 const comm::Communicator& comm)
{
  std::vector<FilledDomain> all;
  for (const Bytes& bytes : comm.gather_to_root(to_bytes(filled))) {
    auto some = from_bytes<std::vector<FilledDomain>>(bytes);
    std::ranges::move(some, std::back_inserter(all));
  }
  std::ranges::sort(all, {}, &FilledDomain::domain);
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
  return made;
}

CoarseAttempt fill_coarse_surface(const CoarsePlan& plan, coarse::CoarseSurface surface,
                                  StageScope& stage, RunContext& context)
{
  const DomainShare share = fill_domains(surface, plan.options, stage, context);
  auto failed = context.comm.all_gather_rows(share.failed);
  if (!failed.empty()) {
    const auto lowest = std::ranges::min_element(failed, {}, &FailedDomain::domain);
    return {std::move(lowest->outcome), {}};
  }
  std::vector<FilledDomain> filled = gather(share.filled, context.comm);
  CoarseAttempt attempt;
  attempt.outcome = comm::on_root(context.comm, [&] {
    std::size_t num_tets = surface.mesh.tet_vertices.size() / 4;
    for (const FilledDomain& one : filled) num_tets += one.tets.tet_vertices.size() / 4;
    const jobs::JobLimits limits = whole_limits(plan.options, num_tets);
    const Bytes request =
        coarse_mesh_request(std::move(surface), std::move(filled), plan.options, plan.planes);
    jobs::JobOutcome outcome;
    attempt.made = result_of<CoarseTry>({"coarse: whole", request, limits}, wait_for_stop_signal(),
                                        outcome, context);
    return outcome;
  });
  return attempt;
}

}  // namespace tessera::pipeline
