// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/stages/coarse/coarse_part.hpp"

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

#include "pipeline/stages/coarse/coarse_stage.hpp"
#include "pipeline/stages/coarse/coarse_warnings.hpp"
#include "pipeline/stages/coarse/cut_stage.hpp"
#include "pipeline/stages/coarse/decompose_stage.hpp"
#include "pipeline/stages/coarse/layer_stage.hpp"
#include "pipeline/stages/coarse/levels_stage.hpp"
#include "pipeline/stages/coarse/periodic_stage.hpp"
#include "pipeline/stages/coarse/split_stage.hpp"
#include "pipeline/stages/model/model_stage.hpp"
#include "pipeline/stages/model/name_stage.hpp"
#include "pipeline/stages/model/size_stage.hpp"

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

void take(LayeredMesh layered, RunResult& run)
{
  run.coarse.mesh = std::move(layered.mesh);
  run.cover = std::move(layered.cover);
}

// A coarse mesh, and once more where it is too coarse for the sizes.
// @return Whether it is fine enough for them.
bool make_coarse_mesh(const StageList& stages, RunResult& run, RunContext& context)
{
  config::Case& resolved = run.resolved;
  PartsOfCase parts;
  if (contains(stages, Stage::names)) parts = run_name_stage(resolved, run.model.format, context);
  resolved.coarse.kept = std::move(parts.kept);
  resolved.coarse.periodic = std::move(parts.periodic);
  resolved.coarse.has_inner_parts = run.model.assembly.has_inner_parts();
  require_own_surface(run);
  if (contains(stages, Stage::cut)) run.planes = run_cut_stage(run, context);
  run.coarse = run_coarse_stage(resolved, run.figures, run.planes.tree, context);
  model::apply_names(parts.named, run.coarse.mesh);
  return !may_want_a_finer_mesh(resolved) || refine_for_sizes(run, parts.named, context);
}

void choose_levels(const StageList& stages, RunResult& run, RunContext& context)
{
  LevelChoice choice = contains(stages, Stage::levels)
                           ? run_levels_stage(run.resolved, run.coarse.mesh, context)
                           : uniform_levels(run.resolved, run.coarse.mesh);
  run.levels = std::move(choice.levels);
  run.splits = choice.splits;
}

void run_coarse_stages(const StageList& stages, RunResult& run, RunContext& context)
{
  const config::Case& resolved = run.resolved;
  mesh::CoarseMesh& mesh = run.coarse.mesh;
  const bool is_fine_enough = make_coarse_mesh(stages, run, context);
  if (contains(stages, Stage::periodic)) mesh = run_periodic_stage(resolved, mesh, context);
  if (contains(stages, Stage::split)) {
    mesh = run_split_stage(resolved, run_rim_stage(resolved, std::move(mesh), context), context);
  }
  if (contains(stages, Stage::layers)) take(run_layer_stage(resolved, mesh, context), run);
  choose_levels(stages, run, context);
  if (!is_fine_enough) run.coarse.missed_size = longest_edge_in_sizes(run, context);
  // Until here sizes and layers know both sides of a split by the name of the patch.
  mesh.patch_names = mesh::final_patch_names(mesh);
  run.decomposition = run_decompose_stage(run, context);
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

StageList coarse_stages(const config::Case& resolved, model::Format format)
{
  StageList stages{Stage::model};
  append_if(names_parts(resolved, format), Stage::names, stages);
  append_if(resolved.decompose.method == decompose::Method::geometry, Stage::cut, stages);
  stages.push_back(Stage::coarse);
  append_if(may_want_a_finer_mesh(resolved), Stage::levels, stages);  // A look at the sizes.
  append_if(!resolved.periodic.empty(), Stage::periodic, stages);
  append_if(!openings_of(resolved).are_none(), Stage::split, stages);
  append_if(!resolved.layers.empty(), Stage::layers, stages);
  append_if(sizing::are_wanted(resolved.size), Stage::levels, stages);
  stages.push_back(Stage::decompose);
  return stages;
}

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
      run_size_stage(given, run.figures, given.geometry.scale * run.model.wrap.tolerance, context);
  run.resolved.fill = config::resolved_fill(given, !options.only_subdomains.empty());
  if (kept) {
    run.planes = std::move(kept->planes);
    run.coarse = std::move(kept->coarse);
    run.cover = std::move(kept->cover);
    run.levels = kept->levels;  // A copy does not hold the memory of all that was kept.
    run.splits = kept->splits;
    run.decomposition = std::move(kept->decomposition);
  } else {
    run_coarse_stages(coarse_stages(run.resolved, run.model.format), run, context);
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
