// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/stages/coarse/periodic_stage.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "tessera/comm/share_on_node.hpp"
#include "tessera/topology/periodic_sides.hpp"

#include "pipeline/runtime/with_file_context.hpp"

namespace tessera::pipeline {

mesh::CoarseMesh run_periodic_stage(const config::Case& run_case, const mesh::CoarseMesh& coarse,
                                    RunContext& context)
{
  StageScope stage(context, Stage::periodic);
  mesh::CoarseMesh made = comm::on_root_of_nodes(context.comm, [&] {
    return with_file_context(run_case, [&] {
      mesh::CoarseMesh joined = coarse;
      topology::join_periodic_sides(joined, run_case.periodic);
      return joined;
    });
  });
  const auto& origins = made.images.face_origin;
  const auto num_images =
      std::ssize(origins) - std::ranges::count(std::as_const(origins), kNoIndex);
  stage.work_is_done();
  stage.finish(fmt::format("{} coarse triangles are images", num_images));
  return made;
}

}  // namespace tessera::pipeline
