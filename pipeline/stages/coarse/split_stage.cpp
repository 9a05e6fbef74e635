// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/stages/coarse/split_stage.hpp"

#include <fmt/format.h>

#include "tessera/comm/all_or_none.hpp"
#include "tessera/comm/share_on_node.hpp"

#include "pipeline/jobs/mesh_worker.hpp"
#include "pipeline/jobs/require_job.hpp"
#include "pipeline/runtime/with_file_context.hpp"

namespace tessera::pipeline {
namespace {

constexpr jobs::JobLimits kSplitLimits{.cpu_s = 1800.0, .stall_s = 120.0, .memory_gib = 16.0};

}  // namespace

topology::SplitOptions openings_of(const config::Case& run_case)
{
  topology::SplitOptions all = run_case.splits;
  for (const layers::LayerOptions& layer : run_case.layers) {
    if (!layer.side.empty()) all.joints.push_back({.patch = layer.patch, .solid = layer.side});
  }
  return all;
}

mesh::CoarseMesh run_rim_stage(const config::Case& run_case, mesh::CoarseMesh coarse,
                               RunContext& context)
{
  const topology::SplitOptions& splits = run_case.splits;
  const bool is_near = comm::on_root(context.comm, [&] {
    return with_file_context(run_case, [&] { return topology::are_rims_near(coarse, splits); });
  });
  if (!is_near) return coarse;
  return comm::on_root_of_nodes(context.comm, [&] {
    return with_file_context(run_case, [&] {
      const Bytes request = rim_request(coarse, splits);
      return require_job({"rims", request, kSplitLimits}, from_bytes<mesh::CoarseMesh>, "[[split]]",
                         context);
    });
  });
}

mesh::CoarseMesh run_split_stage(const config::Case& run_case, const mesh::CoarseMesh& closed,
                                 RunContext& context)
{
  StageScope stage(context, Stage::split);
  mesh::CoarseMesh open = comm::on_root_of_nodes(context.comm, [&] {
    return with_file_context(run_case, [&] {
      mesh::CoarseMesh made = closed;
      topology::split_patches(made, openings_of(run_case));
      return made;
    });
  });
  const LocalIndex num_double = open.num_vertices() - closed.num_vertices();
  stage.work_is_done();
  stage.finish(fmt::format("{} coarse points are double", num_double));
  return open;
}

}  // namespace tessera::pipeline
