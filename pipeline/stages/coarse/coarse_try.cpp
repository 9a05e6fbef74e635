// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/stages/coarse/coarse_try.hpp"

#include <algorithm>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "tessera/comm/all_or_none.hpp"
#include "tessera/surface/coarse_surface.hpp"

#include "pipeline/jobs/failed_jobs.hpp"
#include "pipeline/jobs/for_each_dynamic.hpp"
#include "pipeline/stages/coarse/coarse_budget.hpp"

namespace tessera::pipeline {
namespace {

// What this process has noted afterwards are the repairs of the job.
template <class Result>
JobResult<Result> result_of(const JobRequest& job, const jobs::JobRunner::WaitCallback& on_wait,
                            RunContext& context)
{
  static_cast<void>(take_noted_repairs());
  auto result = attempt_job(job, from_bytes<Result>, on_wait, context);
  keep_if_failed(job, result.end, context);
  context.log.debug(
      fmt::format("{}: {:.2f} of {:.0f} s of CPU time", job.name, result.cpu_s, job.limits.cpu_s));
  return result;
}

struct FilledDomain {
  LocalIndex domain = 0;  // From 1.
  surface::DomainTets tets{};

  static auto fields(auto& self) { return std::tie(self.domain, self.tets); }
};

struct FailedDomain {
  LocalIndex domain = 0;
  jobs::JobEnd end{};

  static auto fields(auto& self) { return std::tie(self.domain, self.end); }
};

// What this rank made of the domains of a surface.
struct DomainShare {
  std::vector<FilledDomain> filled{};
  RepairCounts repairs{};
  std::vector<FailedDomain> failed{};
};

std::vector<double> triangles_of_domains(const surface::CoarseSurface& surface)
{
  std::vector<double> num_triangles(at(surface.num_domains()));
  for (const auto& domains : surface.face_domains) {
    for (const LocalIndex domain : domains) {
      if (domain > 0) num_triangles[at(domain - 1)] += 1.0;
    }
  }
  return num_triangles;
}

DomainShare fill_share(const surface::CoarseSurface& surface, const surface::CoarseOptions& options,
                       StageScope& stage, RunContext& context)
{
  DomainShare share;
  const std::vector<double> weights = triangles_of_domains(surface);
  const auto fill = [&](LocalIndex item, const jobs::JobRunner::WaitCallback& on_wait) {
    const LocalIndex domain = item + 1;
    surface::DomainSkin skin = surface::skin_of(surface, domain);
    jobs::JobLimits limits = domain_limits(options, skin);
    limits.is_alone = weights.size() == 1;
    const Bytes request = coarse_domain_request(std::move(skin), options);
    auto [tets, end, cpu_s] = result_of<surface::DomainTets>(
        {fmt::format("coarse: domain {}", domain), request, limits}, on_wait, context);
    if (tets) {
      share.repairs += take_noted_repairs();
      share.filled.push_back({domain, std::move(*tets)});
    } else {
      share.failed.push_back({domain, std::move(end)});
    }
  };
  for_each_dynamic(heaviest_first(weights), fill, stage, context);
  return share;
}

// All domains, on rank 0; or the first that failed, on every rank.
struct DomainTry {
  std::optional<FailedDomain> failed{};
  std::vector<surface::DomainTets> filled{};
  RepairCounts repairs{};
};

DomainTry fill_domains(const surface::CoarseSurface& surface, const surface::CoarseOptions& options,
                       StageScope& stage, RunContext& context)
{
  const DomainShare share = fill_share(surface, options, stage, context);
  auto failed = context.comm.all_gather_rows(share.failed);
  if (!failed.empty())
    return {std::move(*std::ranges::min_element(failed, {}, &FailedDomain::domain)), {}, {}};
  DomainTry all;
  for (const Bytes& bytes : context.comm.gather_to_root(to_bytes(share.repairs))) {
    all.repairs += from_bytes<RepairCounts>(bytes);
  }
  all.filled.resize(context.comm.rank() == 0 ? at(surface.num_domains()) : 0);
  for (const Bytes& bytes : context.comm.gather_to_root(to_bytes(share.filled))) {
    for (FilledDomain& one : from_bytes<std::vector<FilledDomain>>(bytes)) {
      all.filled[at(one.domain - 1)] = std::move(one.tets);
    }
  }
  return all;
}

}  // namespace

SurfaceTry try_coarse_surface(const CoarsePlan& plan, const jobs::JobRunner::WaitCallback& on_wait,
                              RunContext& context)
{
  // Gmsh is a child of the job and has the same limit.
  surface::CoarseOptions options = plan.options;
  options.timeout_s = plan.limits.cpu_s;
  const Bytes request = coarse_surface_request(options, plan.planes, plan.rung);
  auto [surface, end, cpu_s] =
      result_of<surface::CoarseSurface>({"coarse", request, plan.limits}, on_wait, context);
  return {std::move(end), std::move(surface), take_noted_repairs()};
}

CoarseAttempt fill_coarse_surface(const CoarsePlan& plan, surface::CoarseSurface surface,
                                  StageScope& stage, RunContext& context)
{
  DomainTry domains = fill_domains(surface, plan.options, stage, context);
  if (domains.failed) return {.end = std::move(domains.failed->end)};
  CoarseAttempt attempt{.repairs = domains.repairs};
  attempt.end = comm::on_root(context.comm, [&] {
    std::size_t num_tets = surface.mesh.tet_vertices.size() / 4;
    for (const auto& tets : domains.filled) num_tets += tets.tet_vertices.size() / 4;
    const jobs::JobLimits limits = whole_limits(plan.options, static_cast<double>(num_tets));
    const Bytes request = coarse_mesh_request(std::move(surface), std::move(domains.filled),
                                              plan.options, plan.planes);
    auto whole =
        result_of<CoarseTry>({"coarse: whole", request, limits}, wait_for_stop_signal(), context);
    attempt.repairs += take_noted_repairs();
    attempt.made = std::move(whole.made);
    return whole.end;
  });
  return attempt;
}

}  // namespace tessera::pipeline
