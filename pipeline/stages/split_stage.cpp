// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/stages/split_stage.hpp"

#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "tessera/comm/all_or_none.hpp"
#include "tessera/comm/share_on_node.hpp"

#include "pipeline/jobs/mesh_worker.hpp"
#include "pipeline/jobs/require_job.hpp"
#include "pipeline/runtime/with_file_context.hpp"

namespace tessera::pipeline {
namespace {

constexpr jobs::JobLimits kSplitLimits{.cpu_s = 1800.0, .stall_s = 120.0, .memory_gib = 16.0};

struct OpenMesh {
  mesh::CoarseMesh mesh{};
  mesh::EdgeLevels levels{};

  static auto fields(auto& self) { return std::tie(self.mesh, self.levels); }
};

}  // namespace

void divide_at_rims(RunResult& run, RunContext& context)
{
  const topology::SplitOptions& splits = run.resolved.splits;
  if (splits.are_none()) return;
  const bool is_near = comm::on_root(context.comm, [&] {
    return with_file_context(run.resolved,
                             [&] { return topology::are_rims_near(run.coarse.mesh, splits); });
  });
  if (!is_near) return;
  run.coarse.mesh = comm::on_root_of_nodes(context.comm, [&] {
    return with_file_context(run.resolved, [&] {
      const Bytes request = rim_request(run.coarse.mesh, splits);
      return require_job({"rims", request, kSplitLimits}, from_bytes<mesh::CoarseMesh>, "[[split]]",
                         context);
    });
  });
}

void split_patches(RunResult& run, RunContext& context)
{
  if (run.resolved.splits.are_none()) return;
  StageScope stage(context, "split");
  OpenMesh open = comm::on_root_of_nodes(context.comm, [&] {
    return with_file_context(run.resolved, [&] {
      OpenMesh made{.mesh = run.coarse.mesh, .levels = run.levels};
      topology::split_patches(made.mesh, run.resolved.splits, made.levels);
      return made;
    });
  });
  const LocalIndex num_double = open.mesh.num_vertices() - run.coarse.mesh.num_vertices();
  run.coarse.mesh = std::move(open.mesh);
  run.levels = open.levels;
  stage.work_is_done();
  stage.finish(fmt::format("{} coarse points are double", num_double));
}

}  // namespace tessera::pipeline
