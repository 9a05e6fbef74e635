// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/stages/coarse_stage.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "tessera/base/error.hpp"
#include "tessera/comm/all_or_none.hpp"

#include "pipeline/jobs/for_each_dynamic.hpp"
#include "pipeline/stages/coarse_try.hpp"

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

[[noreturn]] void throw_no_mesh(const CoarseResult& result, const std::string& file)
{
  std::string failures;
  for (const std::string& failure : result.failures) failures += "\n  " + failure;
  throw MeshError(
      fmt::format("{}: no coarse mesh could be made; try another coarse.max_size, a longer "
                  "coarse.timeout_s, or repair the model{}",
                  file, failures));
}

void throw_if_hopeless(const jobs::JobOutcome& outcome, const std::string& file)
{
  // Another try would be another mesh, and nothing is wrong with this one.
  if (was_killed_from_outside(outcome)) {
    throw MeshError(fmt::format("coarse: {}{}", outcome.message, way_on(outcome)));
  }
  if (is_final(outcome)) jobs::throw_unless_ok(outcome, file);
}

// A mesh that the user brings is the coarse mesh; no other one could be made.
std::vector<coarse::CoarseOptions> tries_for(const config::Case& run_case)
{
  if (model::is_mesh_name(run_case.geometry.file)) return {run_case.coarse};
  return coarse_fallbacks(run_case.coarse);
}

// Options, and whether the model is cut before.
struct Attempt {
  coarse::CoarseOptions options{};
  bool is_cut = false;
};

// Parts that NETGEN cannot mesh once are tried finer once. What worked uncut must go on to work.
std::vector<Attempt> attempts_at(const config::Case& run_case, const cut::CutTree& planes)
{
  constexpr std::size_t kTriesOfParts = 2;
  const std::vector<coarse::CoarseOptions> fallbacks = tries_for(run_case);
  std::vector<Attempt> attempts;
  if (planes.num_parts > 0) {
    for (std::size_t i = 0; i < std::min(kTriesOfParts, fallbacks.size()); ++i) {
      attempts.push_back({fallbacks[i], true});
    }
  }
  for (const coarse::CoarseOptions& options : fallbacks) attempts.push_back({options, false});
  return attempts;
}

// The mesh is that of rank 0 only; it has no tets if no try worked.
CoarseResult first_that_works(const config::Case& run_case, const cut::CutTree& planes,
                              StageScope& stage, RunContext& context)
{
  const jobs::JobLimits limits{run_case.coarse.timeout_s, kStall_s, kMemory_gib};
  const std::string file = run_case.geometry.file.string();
  CoarseResult result;
  bool was_endless = false;
  bool was_cut = false;
  for (const auto& [options, is_cut] : attempts_at(run_case, planes)) {
    if (was_cut && !is_cut) {
      context.log.warn("coarse: the parts of the model cannot be meshed; it is meshed as a whole");
      was_endless = false;
    }
    was_cut = is_cut;
    // NETGEN's surface mesher that did not end once would not end at another size either.
    const bool is_netgen = options.surface_mesher == coarse::SurfaceMesher::netgen;
    if (was_endless && is_netgen) continue;
    CoarseAttempt made =
        try_coarse_mesh({options, is_cut ? planes : cut::CutTree{}}, limits, stage, context);
    const jobs::JobOutcome& outcome = made.outcome;
    ++result.tries;
    result.options = options;
    if (outcome.status == jobs::JobStatus::ok) {
      if (made.made) {
        result.mesh = std::move(made.made->mesh);
        result.tet_part = std::move(made.made->tet_part);
        result.distance = made.made->distance;
      }
      return result;
    }
    all_or_none(context.comm, [&] { throw_if_hopeless(outcome, file); });
    result.failures.push_back(
        fmt::format("{}{}: {}", is_cut ? "in parts, " : "", name_of(options), outcome.message));
    context.log.warn("coarse: try {} failed: {}", result.tries, result.failures.back());
    was_endless = was_endless || is_endless(outcome);
    result.was_limited = result.was_limited || depends_on_machine(outcome);
  }
  return result;
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

CoarseResult run_coarse_stage(const config::Case& run_case, const cut::CutTree& planes,
                              RunContext& context)
{
  StageScope stage(context, "coarse");
  CoarseResult result = first_that_works(run_case, planes, stage, context);
  result = on_root(context.comm, [&] {
    if (result.mesh.num_tets() == 0) throw_no_mesh(result, run_case.geometry.file.string());
    return std::move(result);
  });
  stage.work_is_done();
  stage.finish(fmt::format("{} tets, {} patches, {} materials", result.mesh.num_tets(),
                           result.mesh.num_patches(), result.mesh.num_materials()));
  return result;
}

}  // namespace tessera::pipeline
