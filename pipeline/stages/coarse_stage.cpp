// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/stages/coarse_stage.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "tessera/base/error.hpp"
#include "tessera/comm/all_or_none.hpp"

#include "pipeline/jobs/failed_jobs.hpp"
#include "pipeline/jobs/for_each_dynamic.hpp"
#include "pipeline/jobs/mesh_worker.hpp"

namespace tessera::pipeline {
namespace {

constexpr double kStall_s = 120.0;
constexpr double kMemory_gib = 16.0;

// The model will not get better in another try.
bool is_final(const jobs::JobOutcome& outcome)
{
  return outcome.error == ErrorKind::geometry || outcome.error == ErrorKind::input
         || outcome.error == ErrorKind::config || outcome.loads_are_lost;
}

bool is_endless(const jobs::JobOutcome& outcome)
{
  return outcome.status == jobs::JobStatus::out_of_time
         || outcome.status == jobs::JobStatus::stalled;
}

std::string name_of(const coarse::CoarseOptions& options)
{
  const bool is_remesh = options.surface_mesher == coarse::SurfaceMesher::remesh;
  return fmt::format("{}max_size {:g}", is_remesh ? "remeshed triangles, " : "", options.max_size);
}

// A mesh that the user brings is the coarse mesh; no other one could be made.
std::vector<coarse::CoarseOptions> tries_for(const config::Case& run_case)
{
  if (model::is_mesh_name(run_case.geometry.file)) return {run_case.coarse};
  return coarse_fallbacks(run_case.coarse);
}

CoarseResult first_that_works(const config::Case& run_case, RunContext& context)
{
  const jobs::JobLimits limits{run_case.coarse.timeout_s, kStall_s, kMemory_gib};
  CoarseResult result;
  bool was_endless = false;
  for (const coarse::CoarseOptions& options : tries_for(run_case)) {
    // NETGEN's surface mesher that did not end once would not end at another size either.
    const bool is_netgen = options.surface_mesher == coarse::SurfaceMesher::netgen;
    if (was_endless && is_netgen) continue;
    const Bytes request = coarse_request(options);
    const JobRequest job{"coarse", request, limits};
    jobs::JobOutcome outcome = run_job(job, wait_for_stop_signal(), context);
    auto made = read_result(outcome, from_bytes<CoarseTry>);
    keep_if_failed(job, outcome, context);
    ++result.tries;
    if (made) {
      result.mesh = std::move(made->mesh);
      result.distance = made->distance;
      result.options = options;
      return result;
    }
    throw_if_cancelled(outcome);
    // Another try would be another mesh, and nothing is wrong with this one.
    if (was_killed_from_outside(outcome)) {
      throw MeshError(fmt::format("coarse: {}{}", outcome.message, way_on(outcome)));
    }
    if (is_final(outcome)) jobs::throw_unless_ok(outcome, run_case.geometry.file.string());
    result.failures.push_back(fmt::format("{}: {}", name_of(options), outcome.message));
    context.log.warn("coarse: try {} failed: {}", result.tries, result.failures.back());
    was_endless = was_endless || is_endless(outcome);
    result.was_limited = result.was_limited || depends_on_machine(outcome);
  }
  std::string failures;
  for (const std::string& failure : result.failures) failures += "\n  " + failure;
  throw MeshError(
      fmt::format("{}: no coarse mesh could be made; try another coarse.max_size, a longer "
                  "coarse.timeout_s, or repair the model{}",
                  run_case.geometry.file.string(), failures));
}

}  // namespace

std::vector<coarse::CoarseOptions> coarse_fallbacks(const coarse::CoarseOptions& asked)
{
  std::vector<coarse::CoarseOptions> fallbacks{asked};
  for (const double factor : {0.7, 0.5}) {
    coarse::CoarseOptions finer = asked;
    finer.max_size *= factor;
    finer.grading = std::min(finer.grading, 0.2);
    fallbacks.push_back(finer);
  }
  coarse::CoarseOptions rounder = asked;
  rounder.curvature *= 2.0;
  fallbacks.push_back(rounder);
  if (asked.mesher == coarse::Mesher::gmsh) return fallbacks;
  for (const double factor : {1.0, 0.5}) {
    coarse::CoarseOptions remeshed = asked;
    remeshed.max_size *= factor;
    remeshed.surface_mesher = coarse::SurfaceMesher::remesh;
    fallbacks.push_back(remeshed);
  }
  return fallbacks;
}

CoarseResult run_coarse_stage(const config::Case& run_case, RunContext& context)
{
  StageScope stage(context, "coarse");
  CoarseResult result = on_root(context.comm, [&] { return first_that_works(run_case, context); });
  stage.work_is_done();
  stage.finish(fmt::format("{} tets, {} patches, {} materials", result.mesh.num_tets(),
                           result.mesh.num_patches(), result.mesh.num_materials()));
  return result;
}

}  // namespace tessera::pipeline
