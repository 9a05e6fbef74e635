// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/stages/fill/untangle_stage.hpp"

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "tessera/base/error.hpp"
#include "tessera/mesh/orbits.hpp"

#include "pipeline/estimate/run_outline.hpp"
#include "pipeline/jobs/failed_jobs.hpp"
#include "pipeline/jobs/for_each_dynamic.hpp"
#include "pipeline/jobs/mesh_worker.hpp"

namespace tessera::pipeline {
namespace {

constexpr int kFirstLookLevels = 2;

// A fork costs as much as the test of a small subdomain: with many of them a job takes several.
constexpr std::size_t kMostJobs = 512;

constexpr jobs::JobLimits kUntangleLimits{.cpu_s = 1800.0, .stall_s = 120.0, .memory_gib = 8.0};

// The first plan looks at coarse levels only, so that it does not cost as much as the subdivision
// itself. Subdivision finds bad children of fine levels by itself, and comes back for a plan of all
// levels. But layers that are split afterwards must be positive however their prisms are cut, and a
// fill looks at them only as they are cut.
UntangleTest test_of(LocalIndex subdomain, const UntangleWork& work)
{
  const fill::KernelKind kernel = work.kernels[at(subdomain)];
  const bool may_split_layers =
      !work.cut.coarse.layers.are_none() && !are_counts_known(work.kernels);
  const bool is_first_look = kernel == fill::KernelKind::subdivide
                             && work.depth == UntangleDepth::coarse_levels && !may_split_layers;
  const int levels = work.cut.levels.largest();
  return {subdomain, kernel, is_first_look ? std::min(levels, kFirstLookLevels) : levels};
}

// The tests of all jobs, at most kMostJobs.
std::vector<std::vector<UntangleTest>> jobs_of(const std::vector<LocalIndex>& subdomains,
                                               const UntangleWork& work)
{
  const std::size_t tests_a_job = (subdomains.size() + kMostJobs - 1) / kMostJobs;
  std::vector<std::vector<UntangleTest>> jobs;
  for (const LocalIndex s : subdomains) {
    if (jobs.empty() || jobs.back().size() == tests_a_job) jobs.emplace_back();
    jobs.back().push_back(test_of(s, work));
  }
  return jobs;
}

// What this rank's share of the subdomains finds under the limits so far.
std::vector<mesh::PointLimit> test_subdomains(const std::vector<LocalIndex>& subdomains,
                                              const UntangleWork& work,
                                              const mesh::ProjectionLimiter& limiter,
                                              StageScope& stage, RunContext& context)
{
  const auto jobs = jobs_of(subdomains, work);
  std::vector<mesh::PointLimit> found;
  const auto test = [&](LocalIndex job, const jobs::JobRunner::WaitCallback& on_wait) {
    const std::vector<UntangleTest>& tests = jobs[at(job)];
    const Bytes request = untangle_request(tests, limiter);
    const JobRequest plan{"plan", request, kUntangleLimits};
    const auto [smaller, end, cpu_s] =
        attempt_job(plan, from_bytes<mesh::ProjectionLimiter>, on_wait, context);
    keep_if_failed(plan, end, context);
    if (!smaller) {
      throw MeshError(fmt::format("plan from subdomain {} on: {}{}", tests.front().subdomain,
                                  end.message, way_on(end)));
    }
    found.insert(found.end(), smaller->entries().begin(), smaller->entries().end());
  };
  for_each_dynamic(in_order(jobs.size()), test, stage, context);
  return found;
}

std::vector<mesh::PointLimit> gather(const std::vector<mesh::PointLimit>& found,
                                     const comm::Communicator& comm)
{
  std::vector<mesh::PointLimit> all;
  for (const mesh::ProjectionLimiter& part :
       comm.all_gather_values(mesh::ProjectionLimiter(found))) {
    all.insert(all.end(), part.entries().begin(), part.entries().end());
  }
  return all;
}

// Subdomains that hold one of the points, in ascending order.
std::vector<LocalIndex> subdomains_around(const std::vector<mesh::PointLimit>& points,
                                          const mesh::Skeleton& skeleton)
{
  std::set<LocalIndex> edges;
  std::set<LocalIndex> triangles;
  for (const mesh::PointLimit& point : points) {
    (point.key.carrier == mesh::LatticeCarrier::edge ? edges : triangles).insert(point.key.entity);
  }
  std::set<LocalIndex> around;
  for (LocalIndex t = 0; t < skeleton.num_triangles(); ++t) {
    const auto at = static_cast<std::size_t>(t);
    const auto touches = [&](std::size_t side) {
      return edges.count(skeleton.triangle_edges[3 * at + side]) > 0;
    };
    if (triangles.count(t) == 0 && !touches(0) && !touches(1) && !touches(2)) continue;
    around.insert(skeleton.triangle_subdomains[2 * at]);
    around.insert(skeleton.triangle_subdomains[2 * at + 1]);
  }
  around.erase(kNoIndex);
  return {around.begin(), around.end()};
}

}  // namespace

mesh::ProjectionLimiter run_untangle_stage(const UntangleWork& work,
                                           mesh::ProjectionLimiter limiter, RunContext& context)
{
  StageScope stage(context, Stage::plan);
  std::vector<LocalIndex> subdomains = work.subdomains;
  while (!subdomains.empty()) {
    const auto found = mesh::on_whole_orbits(
        gather(test_subdomains(subdomains, work, limiter, stage, context), context.comm),
        work.cut.skeleton.orbits);
    std::vector<mesh::PointLimit> all(limiter.entries().begin(), limiter.entries().end());
    all.insert(all.end(), found.begin(), found.end());
    limiter = mesh::ProjectionLimiter(std::move(all));
    subdomains = subdomains_around(found, work.cut.skeleton);
  }
  stage.finish(limiter.entries().empty()
                   ? "no folds"
                   : fmt::format("{} points kept off the geometry", limiter.entries().size()));
  return limiter;
}

}  // namespace tessera::pipeline
