// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/run_plan.hpp"

#include <fmt/format.h>

#include "tessera/base/error.hpp"
#include "tessera/comm/all_or_none.hpp"
#include "tessera/mesh/lattice.hpp"

#include "pipeline/estimate/only_subdomains.hpp"
#include "pipeline/runtime/with_file_context.hpp"
#include "pipeline/stages/coarse/coarse_part.hpp"
#include "pipeline/stages/fill/improve_stage.hpp"
#include "pipeline/stages/output/export_stage.hpp"

namespace tessera::pipeline {

std::vector<subdomain::SubdomainRange> output_ranges(const RunResult& run,
                                                     const RunOptions& options)
{
  const LocalIndex num_subdomains = run.decomposition.decomposition.num_subdomains();
  const std::vector<LocalIndex>& only = options.only_subdomains;
  const std::vector<LocalIndex>& part_offsets = run.decomposition.decomposition.part_offsets;
  if (only.empty() && !part_offsets.empty()) return subdomain::part_ranges(part_offsets);
  if (only.empty()) return subdomain::file_ranges(num_subdomains, run.resolved.output.files);
  return ranges_of_only(only, run.kernels);
}

// Of a scaled mesh only the user knows the unit.
std::string output_length_unit(const RunResult& run)
{
  return run.resolved.geometry.scale == 1.0 ? run.model.length_unit : std::string{};
}

namespace {

PieceChoices choices_of(const RunResult& run, const subdomain::PartitionedMesh& cut,
                        const RunOptions& options)
{
  return {.splits = run.splits,
          .divides_corners = divides_corners(run.resolved.fill, run.kernels),
          .improves_seams = run.resolved.improve.seams && have_seams_to_improve(cut, run.kernels),
          .has_files = !options.on_piece,
          .is_curved = run.resolved.output.order == 2};
}

// A node of second order is a point of one level more.
void require_levels_possible(const RunOutline& outline)
{
  constexpr int kMost = mesh::lattice::kMaxLevels - 1;
  if (!outline.is_curved || outline.levels <= kMost) return;
  throw ConfigError(fmt::format("output.order = 2 leaves at most {} levels; set refine.levels = {}",
                                kMost, kMost));
}

}  // namespace

StageList stages_of(const RunResult& run, const RunOutline& outline)
{
  const config::Case& resolved = run.resolved;
  StageList stages = coarse_stages(resolved, run.model.format);
  stages.insert(stages.end(), {Stage::plan, Stage::fill});
  append_if(outline.improves_seams, Stage::improve, stages);
  stages.push_back(Stage::verify);
  if (outline.splits_pieces()) {
    stages.insert(stages.end(), {outline.is_curved ? Stage::curve : Stage::refine, Stage::verify});
  }
  append_if(outline.writes_from_store(), Stage::write, stages);
  append_if(!outline.has_files, Stage::hand_over, stages);
  append_if(outline.has_files && !resolved.periodic.empty(), Stage::partners, stages);
  append_if(resolved.output.report_html, Stage::pictures, stages);
  const bool has_others = !other_formats(resolved.output).empty();
  append_if(outline.has_files && has_others, Stage::export_formats, stages);
  append_if(outline.has_files && !has_others && resolved.output.parts > 0, Stage::neighbours,
            stages);
  return stages;
}

RunPlan plan_run(const RunResult& run, const subdomain::PartitionedMesh& cut,
                 const RunOptions& options, const RunContext& context)
{
  RunPlan plan{.length_unit = output_length_unit(run)};
  all_or_none(context.comm, [&] {
    with_file_context(run.resolved, [&] {
      plan.outline =
          outline_run(cut, run.kernels, output_ranges(run, options), choices_of(run, cut, options));
      require_levels_possible(plan.outline);
    });
    plan.stages = stages_of(run, plan.outline);
  });
  return plan;
}

std::string text_of(const StageList& stages)
{
  std::vector<std::string_view> words;
  for (const Stage stage : stages) words.push_back(word_of(stage));
  return fmt::format("{}", fmt::join(words, ", "));
}

}  // namespace tessera::pipeline
