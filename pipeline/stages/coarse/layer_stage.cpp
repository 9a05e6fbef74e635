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

// Tets more than that many times as high as one more layer would be are worth a word: nobody wants
// cells to grow as fast.
constexpr double kJump = 2.0;

// How many layers a case gives is its own choice, and so is the size inside.
void tell_of_jumps(const config::Case& run_case, const RunContext& context)
{
  const double of_tets = layers::height_of_tets(run_case.size.target);
  for (const layers::LayerOptions& layer : run_case.layers) {
    const double last = layers::last_height(layer);
    if (of_tets <= kJump * layer.growth * last) continue;
    context.log.info(
        fmt::format("layers: the last one of \"{}\" is {:.3g} high, and tets of "
                    "size.target are {:.3g}; without count and thickness, as many "
                    "layers are made as lead up to that",
                    layer.patch, last, of_tets));
  }
}

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
  tell_of_jumps(run_case, context);
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
