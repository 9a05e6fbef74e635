// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/stages/layer_stage.hpp"

#include <utility>

#include <fmt/format.h>

#include "tessera/comm/all_or_none.hpp"
#include "tessera/comm/share_on_node.hpp"

#include "pipeline/jobs/mesh_worker.hpp"
#include "pipeline/jobs/require_job.hpp"
#include "pipeline/runtime/with_file_context.hpp"

namespace tessera::pipeline {
namespace {

constexpr jobs::JobLimits kLayerLimits{.cpu_s = 3600.0, .stall_s = 120.0, .memory_gib = 16.0};

LayeredMesh layered(const RunResult& run, RunContext& context)
{
  const bool is_own = model::is_mesh_name(run.resolved.geometry.file);
  const Bytes request = layer_request(run.coarse.mesh, run.resolved.layers, is_own);
  return require_job({"layers", request, kLayerLimits}, from_bytes<LayeredMesh>, "[[layer]]",
                     context);
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
