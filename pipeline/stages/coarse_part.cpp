// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/stages/coarse_part.hpp"

#include <optional>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "tessera/base/hash.hpp"
#include "tessera/base/repair.hpp"
#include "tessera/comm/all_or_none.hpp"
#include "tessera/comm/share_on_node.hpp"
#include "tessera/config/exclusions.hpp"
#include "tessera/fill/fallbacks.hpp"
#include "tessera/subdomain/read_size_field.hpp"

#include "pipeline/report/defeature_json.hpp"
#include "pipeline/report/sharp_json.hpp"
#include "pipeline/report/size_warning.hpp"
#include "pipeline/stages/coarse_stage.hpp"
#include "pipeline/stages/cut_stage.hpp"
#include "pipeline/stages/decompose_stage.hpp"
#include "pipeline/stages/layer_stage.hpp"
#include "pipeline/stages/levels_stage.hpp"
#include "pipeline/stages/model_stage.hpp"
#include "pipeline/stages/name_stage.hpp"
#include "pipeline/stages/periodic_stage.hpp"
#include "pipeline/stages/size_stage.hpp"
#include "pipeline/stages/split_stage.hpp"

namespace tessera::pipeline {
namespace {

// What the store keeps of a run before it fills.
struct CutCoarseMesh {
  cut::CutChoice planes{};
  CoarseResult coarse{};
  layers::LayerCover cover{};
  mesh::EdgeLevels levels{};
  int splits = 0;
  decompose::DecomposeResult decomposition{};

  static auto fields(auto& self)
  {
    return std::tie(self.planes, self.coarse, self.cover, self.levels, self.splits,
                    self.decomposition);
  }
};

std::optional<CutCoarseMesh> kept_coarse_mesh(const RunState* state, const RunContext& context)
{
  return comm::on_root_of_nodes(context.comm, [&]() -> std::optional<CutCoarseMesh> {
    const auto record = state == nullptr ? std::nullopt : state->find_coarse();
    return record ? std::optional(from_bytes<CutCoarseMesh>(*record)) : std::nullopt;
  });
}

void keep_coarse_mesh(const RunResult& run, const RunState* state, const RunContext& context)
{
  all_or_none(context.comm, [&] {
    if (state == nullptr || context.comm.rank() != 0) return;
    state->keep_coarse(to_bytes(CutCoarseMesh{run.planes, run.coarse, run.cover, run.levels,
                                              run.splits, run.decomposition}));
  });
}

void require_same_run(const RunResult& run, const RunState* state, const RunContext& context)
{
  all_or_none(context.comm, [&] {
    if (state == nullptr || context.comm.rank() != 0) return;
    state->require_same_run({hash_bytes(run.model.content), run.field_content});
  });
}

// Takes the second mesh if it has tets. What was tried counts in any case.
void replace(CoarseResult& first, CoarseResult second)
{
  second.tries += first.tries;
  second.failures.insert(second.failures.begin(), first.failures.begin(), first.failures.end());
  second.was_limited = second.was_limited || first.was_limited;
  if (second.mesh.num_tets() > 0) {
    first = std::move(second);
    return;
  }
  first.tries = second.tries;
  first.failures = std::move(second.failures);
  first.was_limited = second.was_limited;
}

// Once more where it is too coarse for the sizes. If that cannot be made, the first mesh stays.
// @return Whether it is fine enough now.
bool refine_for_sizes(RunResult& run, const model::NamedParts& parts, RunContext& context)
{
  mesh::SizePoints points = sizes_for_a_finer_mesh(run, context);
  if (points.size.empty()) return true;
  config::Case finer = run.resolved;
  finer.coarse.points = std::move(points);
  CoarseResult second =
      run_second_coarse_stage(finer, run.figures, run.coarse, run.planes.tree, context);
  const bool is_made = on_root(context.comm, [&] { return second.mesh.num_tets() > 0; });
  model::apply_names(parts, second.mesh);
  replace(run.coarse, std::move(second));
  if (is_made) run.resolved = std::move(finer);
  return is_made;
}

// Of a file with such faces or curves; load_case() looks at those of the case.
void require_own_surface(const RunResult& run)
{
  if (!run.resolved.coarse.has_inner_parts) return;
  const bool has_lines = !run.model.assembly.lines.empty();
  std::string_view other = config::excluded_by_inner_faces(run.resolved);
  if (other.empty() && has_lines) other = config::excluded_by_inner_lines(run.resolved);
  if (other.empty()) return;
  throw ConfigError(
      fmt::format("{}: the file has {} inside of solids, which exclude {}; leave that out, or set "
                  "geometry.{} = \"drop\"",
                  run.resolved.geometry.file.string(), has_lines ? "curves" : "faces", other,
                  has_lines ? "loose_curves" : "loose_faces"));
}

// A coarse mesh, and once more where it is too coarse for the sizes.
void run_coarse_stages(RunResult& run, RunContext& context)
{
  const PartsOfCase of_case = find_parts_of_case(run.resolved, run.model.format, context);
  const model::NamedParts& parts = of_case.named;
  run.resolved.coarse.kept = of_case.kept;
  run.resolved.coarse.periodic = of_case.periodic;
  run.resolved.coarse.has_inner_parts = run.model.assembly.has_inner_parts();
  require_own_surface(run);
  run.planes = choose_cuts(run, context);
  run.coarse = run_coarse_stage(run.resolved, run.figures, run.planes.tree, context);
  model::apply_names(parts, run.coarse.mesh);
  const bool is_fine_enough = refine_for_sizes(run, parts, context);
  join_periodic_sides(run, context);
  divide_at_rims(run, context);
  grow_layers(run, context);
  choose_levels(run, context);
  if (!is_fine_enough) run.coarse.missed_size = longest_edge_in_sizes(run, context);
  split_patches(run, context);  // The last one: sizes and layers know patches by their names.
}

void tell_what_is_within_tolerance(const RunResult& run, RunContext& context)
{
  const coarse::VertexDistance& distance = run.coarse.distance;
  if (distance.num_within == 0) return;
  context.log.info(fmt::format(
      "coarse: {} vertices are off the geometry by at most {:.3g}: within the tolerance "
      "of the CAD file, or less than {:g} of their edges",
      distance.num_within, distance.largest_within, coarse::kMostOfEdgeOff));
}

void name_sharp_tets(RunResult& run, RunContext& context)
{
  run.sharp = coarse::find_sharp_tets(run.coarse.mesh, kSharpAngle_deg);
  if (const auto warning = sharp_warning(run.sharp))
    context.log.warn(fmt::format("coarse: {}", *warning));
}

// For sizes, and for how long tries at the coarse mesh may take.
bool asks_for_figures(const config::Case& given, bool has_coarse_mesh)
{
  return given.size.target > 0.0 || !(has_coarse_mesh || given.coarse.timeout_s > 0.0);
}

}  // namespace

RunResult run_coarse_part(const config::Case& given, const RunOptions& options, RunContext& context)
{
  RunResult run;
  run.only_subdomains = options.only_subdomains;
  static_cast<void>(take_noted_repairs());  // Of other runs.
  run.model = run_model_stage(given, context);
  run.import_repairs = take_noted_repairs();
  run.field_content =
      comm::on_root(context.comm, [&] { return subdomain::size_field_content(given.size); });
  require_same_run(run, options.state, context);
  auto kept = kept_coarse_mesh(options.state, context);
  if (asks_for_figures(given, kept.has_value())) run.figures = measure_model(given, context);
  // A wrap is that rough.
  run.resolved =
      resolve_size(given, run.figures, given.geometry.scale * run.model.wrap.tolerance, context);
  run.resolved.fill = config::resolved_fill(given, !options.only_subdomains.empty());
  if (kept) {
    run.planes = std::move(kept->planes);
    run.coarse = std::move(kept->coarse);
    run.cover = std::move(kept->cover);
    run.levels = kept->levels;  // A copy does not hold the memory of all that was kept.
    run.splits = kept->splits;
    run.decomposition = std::move(kept->decomposition);
  } else {
    run_coarse_stages(run, context);
    run.decomposition = run_decompose_stage(run, context);
    keep_coarse_mesh(run, options.state, context);
  }
  tell_what_is_within_tolerance(run, context);
  if (const auto warning = size_warning(run.coarse))
    context.log.warn(fmt::format("coarse: {}", *warning));
  if (run.coarse.defeatured.is_any()) {
    context.log.info(fmt::format("coarse: {}", defeatured_words(run.coarse)));
  }
  all_or_none(context.comm, [&] {
    if (context.comm.rank() == 0) name_sharp_tets(run, context);
    run.kernels = fill::kernels_of(run.resolved.fill, run.coarse.mesh.material_names,
                                   run.decomposition.decomposition.subdomain_material);
  });
  return run;
}

}  // namespace tessera::pipeline
