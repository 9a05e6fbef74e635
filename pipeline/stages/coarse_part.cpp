// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/stages/coarse_part.hpp"

#include <optional>
#include <tuple>
#include <utility>

#include "tessera/base/error.hpp"
#include "tessera/base/hash.hpp"
#include "tessera/comm/all_or_none.hpp"
#include "tessera/fill/fallbacks.hpp"
#include "tessera/refine/choose_levels.hpp"

#include "pipeline/estimate/run_outline.hpp"
#include "pipeline/stages/coarse_stage.hpp"
#include "pipeline/stages/decompose_stage.hpp"
#include "pipeline/stages/model_stage.hpp"
#include "pipeline/stages/size_stage.hpp"

namespace tessera::pipeline {
namespace {

// What the store keeps of a run before it fills.
struct CutCoarseMesh {
  CoarseResult coarse{};
  mesh::EdgeLevels levels{};
  int splits = 0;
  decompose::DecomposeResult decomposition{};

  static auto fields(auto& self)
  {
    return std::tie(self.coarse, self.levels, self.splits, self.decomposition);
  }
};

std::optional<CutCoarseMesh> kept_coarse_mesh(const RunState* state, const RunContext& context)
{
  return comm::on_root(context.comm, [&]() -> std::optional<CutCoarseMesh> {
    const auto record = state == nullptr ? std::nullopt : state->find_coarse();
    return record ? std::optional(from_bytes<CutCoarseMesh>(*record)) : std::nullopt;
  });
}

void keep_coarse_mesh(const RunResult& run, const RunState* state, const RunContext& context)
{
  all_or_none(context.comm, [&] {
    if (state == nullptr || context.comm.rank() != 0) return;
    state->keep_coarse(
        to_bytes(CutCoarseMesh{run.coarse, run.levels, run.splits, run.decomposition}));
  });
}

void require_same_run(const RunResult& run, const RunState* state, const RunContext& context)
{
  all_or_none(context.comm, [&] {
    if (state == nullptr || context.comm.rank() != 0) return;
    state->require_same_run(hash_bytes(run.model.content));
  });
}

// The same for all edges, unless the case says which size is wanted.
mesh::EdgeLevels wanted_levels(const config::Case& resolved, const mesh::CoarseMesh& coarse)
{
  if (resolved.size.target == 0.0) return resolved.refine.levels;
  std::vector<LocalIndex> edges = refine::coarse_edges(coarse);
  std::vector<double> num_wanted;
  for (std::size_t e = 0; e < edges.size(); e += 2) {
    const Vec3 edge = coarse.position(edges[e + 1]) - coarse.position(edges[e]);
    num_wanted.push_back(norm(edge) / resolved.size.target);
  }
  return refine::choose_levels(coarse, std::move(edges), num_wanted, resolved.refine.levels);
}

// A piece that is split has at least so many levels everywhere.
void choose_levels(RunResult& run, RunContext& context)
{
  const mesh::CoarseMesh& coarse = run.coarse.mesh;
  const mesh::EdgeLevels wanted =
      comm::on_root(context.comm, [&] { return wanted_levels(run.resolved, coarse); });
  const auto kernels =
      fill::kernels_of(run.resolved.fill, coarse.material_names, coarse.tet_material);
  run.splits = splits_after_fill(run.resolved.fill, kernels, wanted.largest());
  run.levels = wanted.raised(run.splits);
}

// Nothing makes sizes differ yet, and no key may be ignored.
void require_one_size(const sizing::SizeOptions& size, const RunContext& context)
{
  all_or_none(context.comm, [&] {
    if (!is_graded(size) && size.min == 0.0 && size.max == 0.0) return;
    throw ConfigError(
        "size.min, size.max, size.field and [[size.region]] have no effect in this version; leave "
        "them out");
  });
}

}  // namespace

RunResult run_coarse_part(const config::Case& given, const RunOptions& options, RunContext& context)
{
  require_one_size(given.size, context);
  RunResult run;
  run.only_subdomains = options.only_subdomains;
  run.model = run_model_stage(given, context);
  require_same_run(run, options.state, context);
  run.resolved = resolve_size(given, context);
  if (auto kept = kept_coarse_mesh(options.state, context)) {
    run.coarse = std::move(kept->coarse);
    run.levels = std::move(kept->levels);
    run.splits = kept->splits;
    run.decomposition = std::move(kept->decomposition);
  } else {
    run.coarse = run_coarse_stage(run.resolved, context);
    choose_levels(run, context);
    run.decomposition = run_decompose_stage(run, context);
    keep_coarse_mesh(run, options.state, context);
  }
  all_or_none(context.comm, [&] {
    run.kernels = fill::kernels_of(run.resolved.fill, run.coarse.mesh.material_names,
                                   run.decomposition.decomposition.subdomain_material);
  });
  return run;
}

}  // namespace tessera::pipeline
