// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/stages/plan_stage.hpp"

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "tessera/base/error.hpp"

#include "pipeline/failed_jobs.hpp"
#include "pipeline/mesh_worker.hpp"
#include "pipeline/share_out.hpp"

namespace tessera::pipeline {
namespace {

constexpr int kFirstLookLevels = 2;

// A fork costs as much as the test of a small subdomain: with many of them a job takes several.
constexpr std::size_t kMostJobs = 512;

constexpr jobs::JobLimits kPlanLimits{.cpu_s = 1800.0, .stall_s = 120.0, .memory_gib = 8.0};

// Subdivision finds bad children of fine levels by itself, and comes back for a plan of all levels;
// so that a plan does not cost as much as the subdivision itself, the first looks at coarse ones.
PlanTest test_of(LocalIndex subdomain, const PlanWork& work)
{
  const fill::KernelKind kernel = work.kernels[at(subdomain)];
  const bool is_first_look =
      kernel == fill::KernelKind::subdivide && work.depth == PlanDepth::coarse_levels;
  return {subdomain, kernel, is_first_look ? std::min(work.levels, kFirstLookLevels) : work.levels};
}

// The tests of all jobs, at most kMostJobs.
std::vector<std::vector<PlanTest>> jobs_of(const std::vector<LocalIndex>& subdomains,
                                           const PlanWork& work)
{
  const std::size_t tests_a_job = (subdomains.size() + kMostJobs - 1) / kMostJobs;
  std::vector<std::vector<PlanTest>> jobs;
  for (const LocalIndex s : subdomains) {
    if (jobs.empty() || jobs.back().size() == tests_a_job) jobs.emplace_back();
    jobs.back().push_back(test_of(s, work));
  }
  return jobs;
}

// What this rank's share of the subdomains finds under the dampings so far.
std::vector<mesh::PointDamping> test_subdomains(const std::vector<LocalIndex>& subdomains,
                                                const PlanWork& work, const mesh::Damping& damping,
                                                StageScope& stage, RunContext& context)
{
  const auto jobs = jobs_of(subdomains, work);
  std::vector<mesh::PointDamping> found;
  const auto test = [&](LocalIndex job, const jobs::JobRunner::WaitCallback& on_wait) {
    const std::vector<PlanTest>& tests = jobs[at(job)];
    const Bytes request = plan_request(tests, damping);
    const JobRequest plan{"plan", request, kPlanLimits};
    jobs::JobOutcome outcome = run_job(plan, on_wait, context);
    const auto smaller = read_result(outcome, mesh::damping_from_bytes);
    keep_if_failed(plan, outcome, context);
    throw_if_cancelled(outcome);
    if (!smaller) {
      throw MeshError("plan from subdomain " + std::to_string(tests.front().subdomain)
                      + " on: " + outcome.message + way_on(outcome));
    }
    found.insert(found.end(), smaller->entries().begin(), smaller->entries().end());
  };
  share_out(in_order(jobs.size()), test, stage, context);
  return found;
}

std::vector<mesh::PointDamping> gather(const std::vector<mesh::PointDamping>& found,
                                       const comm::Communicator& comm)
{
  std::vector<mesh::PointDamping> all;
  for (const Bytes& bytes : comm.all_gather(mesh::to_bytes(mesh::Damping(found)))) {
    const mesh::Damping part = mesh::damping_from_bytes(bytes);
    all.insert(all.end(), part.entries().begin(), part.entries().end());
  }
  return all;
}

// Subdomains that hold one of the points, in ascending order.
std::vector<LocalIndex> subdomains_around(const std::vector<mesh::PointDamping>& points,
                                          const mesh::Skeleton& skeleton)
{
  std::set<LocalIndex> edges;
  std::set<LocalIndex> triangles;
  for (const mesh::PointDamping& point : points) {
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

mesh::Damping run_plan_stage(const PlanWork& work, mesh::Damping damping, RunContext& context)
{
  StageScope stage(context, "plan");
  std::vector<LocalIndex> subdomains = work.subdomains;
  while (!subdomains.empty()) {
    const auto found =
        gather(test_subdomains(subdomains, work, damping, stage, context), context.comm);
    std::vector<mesh::PointDamping> all(damping.entries().begin(), damping.entries().end());
    all.insert(all.end(), found.begin(), found.end());
    damping = mesh::Damping(std::move(all));
    subdomains = subdomains_around(found, work.cut.skeleton);
  }
  stage.finish(damping.entries().empty()
                   ? "no folds"
                   : std::to_string(damping.entries().size()) + " points kept off the geometry");
  return damping;
}

}  // namespace tessera::pipeline
