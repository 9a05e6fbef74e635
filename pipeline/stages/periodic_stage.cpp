// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/stages/periodic_stage.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "tessera/comm/share_on_node.hpp"
#include "tessera/topology/periodic_sides.hpp"

#include "pipeline/runtime/with_file_context.hpp"

namespace tessera::pipeline {

void join_periodic_sides(RunResult& run, RunContext& context)
{
  if (run.resolved.periodic.empty()) return;
  StageScope stage(context, "periodic");
  run.coarse.mesh = comm::on_root_of_nodes(context.comm, [&] {
    return with_file_context(run.resolved, [&] {
      mesh::CoarseMesh joined = run.coarse.mesh;
      topology::join_periodic_sides(joined, run.resolved.periodic);
      return joined;
    });
  });
  const auto& origins = run.coarse.mesh.images.face_origin;
  const auto num_images =
      std::ssize(origins) - std::ranges::count(std::as_const(origins), kNoIndex);
  stage.work_is_done();
  stage.finish(fmt::format("{} coarse triangles are images", num_images));
}

}  // namespace tessera::pipeline
