// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/stages/coarse/layer_stage.hpp"

#include <fmt/format.h>

#include "tessera/comm/all_or_none.hpp"
#include "tessera/comm/share_on_node.hpp"

#include "pipeline/jobs/require_job.hpp"
#include "pipeline/runtime/with_file_context.hpp"

namespace tessera::pipeline {
namespace {

constexpr jobs::JobLimits kLayerLimits{.cpu_s = 3600.0, .stall_s = 120.0, .memory_gib = 16.0};

LayeredMesh layered(const config::Case& run_case, const mesh::CoarseMesh& coarse,
                    RunContext& context)
{
  const bool is_own = model::is_mesh_name(run_case.geometry.file);
  const Bytes request = layer_request(coarse, run_case.layers, is_own);
  return require_job({"layers", request, kLayerLimits}, from_bytes<LayeredMesh>, "[[layer]]",
                     context);
}

}  // namespace

LayeredMesh run_layer_stage(const config::Case& run_case, const mesh::CoarseMesh& coarse,
                            RunContext& context)
{
  StageScope stage(context, Stage::layers);
  LayeredMesh made = comm::on_root_of_nodes(context.comm, [&] {
    return with_file_context(run_case, [&] { return layered(run_case, coarse, context); });
  });
  stage.work_is_done();
  const layers::PatchCover sum = made.cover.sum();
  stage.finish(fmt::format("{:.1f} % of {} patches covered, {:.1f} % at full height",
                           100.0 * sum.covered / sum.area, made.cover.patches.size(),
                           100.0 * sum.full / sum.area));
  return made;
}

}  // namespace tessera::pipeline
