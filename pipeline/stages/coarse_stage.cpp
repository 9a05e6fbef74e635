// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/stages/coarse_stage.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "tessera/base/error.hpp"

#include "pipeline/exit_code.hpp"
#include "pipeline/mesh_worker.hpp"

namespace tessera::pipeline {
namespace {

// 8 k tets/s: an hour is some 3·10^7 coarse tets, more than a coarse mesh should have.
constexpr jobs::JobLimits kCoarseLimits{.cpu_s = 3600.0, .stall_s = 120.0, .memory_gib = 16.0};

CoarseResult climb(const config::Case& run_case, RunContext& context)
{
  std::string failures;
  CoarseResult result;
  for (const coarse::CoarseOptions& options : coarse_ladder(run_case.coarse)) {
    const jobs::JobOutcome outcome =
        context.jobs.run(coarse_request(options), kCoarseLimits, wait_for_stop_signal());
    ++result.tries;
    if (outcome.status == jobs::JobStatus::ok) {
      result.mesh = mesh::coarse_mesh_from_bytes(outcome.result);
      result.options = options;
      return result;
    }
    throw_if_cancelled(outcome);
    const bool is_final =
        outcome.error == jobs::ErrorKind::geometry || outcome.error == jobs::ErrorKind::input;
    if (is_final) jobs::throw_unless_ok(outcome, run_case.geometry.file.string());
    context.log.warn("coarse: try {} with max_size {} failed: {}", result.tries, options.max_size,
                     outcome.message);
    failures += "\n  max_size " + std::to_string(options.max_size) + ": " + outcome.message;
  }
  throw MeshError(run_case.geometry.file.string() + ": no coarse mesh could be made; try another "
                  + "coarse.max_size, or repair the model" + failures);
}

}  // namespace

std::vector<coarse::CoarseOptions> coarse_ladder(const coarse::CoarseOptions& asked)
{
  std::vector<coarse::CoarseOptions> ladder{asked};
  for (const double factor : {0.7, 0.5}) {
    coarse::CoarseOptions finer = asked;
    finer.max_size *= factor;
    finer.grading = std::min(finer.grading, 0.2);
    ladder.push_back(finer);
  }
  coarse::CoarseOptions rounder = asked;
  rounder.curvature *= 2.0;
  ladder.push_back(rounder);
  return ladder;
}

CoarseResult run_coarse_stage(const config::Case& run_case, RunContext& context)
{
  StageScope stage(context, "coarse");
  const Bytes bytes = on_root(context.comm, [&] {
    const CoarseResult climbed = climb(run_case, context);
    ByteWriter out;
    out.put(mesh::to_bytes(climbed.mesh));
    out.put(climbed.options);
    out.put(climbed.tries);
    return std::move(out).take();
  });
  ByteReader in(bytes);
  CoarseResult result;
  result.mesh = mesh::coarse_mesh_from_bytes(in.get_vector<std::byte>());
  result.options = in.get<coarse::CoarseOptions>();
  result.tries = in.get<int>();
  stage.work_is_done();
  stage.finish(std::to_string(result.mesh.num_tets()) + " tets, "
               + std::to_string(result.mesh.num_patches()) + " patches, "
               + std::to_string(result.mesh.num_materials()) + " materials");
  return result;
}

}  // namespace tessera::pipeline
