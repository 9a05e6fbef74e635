// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/stages/layer_stage.hpp"

#include <utility>

#include <fmt/format.h>

#include "tessera/comm/all_or_none.hpp"
#include "tessera/comm/share_on_node.hpp"

#include "pipeline/jobs/failed_jobs.hpp"
#include "pipeline/jobs/for_each_dynamic.hpp"
#include "pipeline/jobs/mesh_worker.hpp"
#include "pipeline/runtime/with_file_context.hpp"

namespace tessera::pipeline {
namespace {

constexpr jobs::JobLimits kLayerLimits{.cpu_s = 3600.0, .stall_s = 120.0, .memory_gib = 16.0};

LayeredMesh layered(const RunResult& run, RunContext& context)
{
  const bool is_own = model::is_mesh_name(run.resolved.geometry.file);
  const Bytes request = layer_request(run.coarse.mesh, run.resolved.layers, is_own);
  const JobRequest job{"layers", request, kLayerLimits};
  jobs::JobOutcome outcome = run_job(job, wait_for_stop_signal(), context);
  auto made = read_result(outcome, from_bytes<LayeredMesh>);
  keep_if_failed(job, outcome, context);
  throw_if_cancelled(outcome);
  outcome.message += way_on(outcome);
  jobs::throw_unless_ok(outcome, "[[layer]]");
  return std::move(*made);
}

}  // namespace

void grow_layers(RunResult& run, RunContext& context)
{
  if (run.resolved.layers.empty()) return;
  StageScope stage(context, "layers");
  LayeredMesh made = comm::on_root_of_nodes(context.comm, [&] {
    return with_file_context(run.resolved, [&] { return layered(run, context); });
  });
  run.coarse.mesh = std::move(made.mesh);
  run.cover = std::move(made.cover);
  stage.work_is_done();
  const layers::PatchCover sum = run.cover.sum();
  stage.finish(fmt::format("{:.1f} % of {} patches covered, {:.1f} % at full height",
                           100.0 * sum.covered / sum.area, run.cover.patches.size(),
                           100.0 * sum.full / sum.area));
}

}  // namespace tessera::pipeline
