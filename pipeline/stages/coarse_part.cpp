// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/stages/coarse_part.hpp"

#include <optional>
#include <tuple>
#include <utility>

#include "tessera/base/error.hpp"
#include "tessera/base/hash.hpp"
#include "tessera/comm/all_or_none.hpp"
#include "tessera/fill/fallbacks.hpp"

#include "pipeline/stages/coarse_stage.hpp"
#include "pipeline/stages/decompose_stage.hpp"
#include "pipeline/stages/model_stage.hpp"
#include "pipeline/stages/size_stage.hpp"

namespace tessera::pipeline {
namespace {

// What the store keeps of a run before it fills.
struct CutCoarseMesh {
  CoarseResult coarse{};
  decompose::DecomposeResult decomposition{};

  static auto fields(auto& self) { return std::tie(self.coarse, self.decomposition); }
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
    state->keep_coarse(to_bytes(CutCoarseMesh{run.coarse, run.decomposition}));
  });
}

void require_same_run(const RunResult& run, const RunState* state, const RunContext& context)
{
  all_or_none(context.comm, [&] {
    if (state == nullptr || context.comm.rank() != 0) return;
    state->require_same_run(hash_bytes(run.model.content));
  });
}

// Once more, finer, if the coarse mesh came out too coarse for the size that the case asks for.
void refit_coarse_mesh(RunResult& run, double target, RunContext& context)
{
  const auto size = corrected_max_size(run.coarse.mesh, run.coarse.options.max_size, target,
                                       run.resolved.refine.levels);
  if (!size) return;
  run.resolved.coarse.max_size = *size;
  const CoarseResult first = std::exchange(run.coarse, run_coarse_stage(run.resolved, context));
  run.coarse.tries += first.tries;
  run.coarse.failures.insert(run.coarse.failures.begin(), first.failures.begin(),
                             first.failures.end());
  run.coarse.was_limited = run.coarse.was_limited || first.was_limited;
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
  run.largest_size = largest_coarse_size(given.size.target, run.resolved.refine.levels);
  if (auto kept = kept_coarse_mesh(options.state, context)) {
    run.coarse = std::move(kept->coarse);
    run.decomposition = std::move(kept->decomposition);
  } else {
    run.coarse = run_coarse_stage(run.resolved, context);
    if (given.size.target > 0.0) refit_coarse_mesh(run, given.size.target, context);
    run.decomposition = run_decompose_stage(run.resolved, run.coarse.mesh, context);
    keep_coarse_mesh(run, options.state, context);
  }
  all_or_none(context.comm, [&] {
    run.kernels = fill::kernels_of(run.resolved.fill, run.coarse.mesh.material_names,
                                   run.decomposition.decomposition.subdomain_material);
  });
  return run;
}

}  // namespace tessera::pipeline
