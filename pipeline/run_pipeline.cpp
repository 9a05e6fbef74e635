// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/run_pipeline.hpp"

#include <utility>

#include "tessera/mesh/lattice_levels.hpp"
#include "tessera/subdomain/partitioned_mesh.hpp"

#include "pipeline/estimate/disk_space.hpp"
#include "pipeline/estimate/output_plan.hpp"
#include "pipeline/stages/coarse_part.hpp"
#include "pipeline/stages/export_stage.hpp"
#include "pipeline/stages/improve_stage.hpp"
#include "pipeline/stages/load_stage.hpp"
#include "pipeline/stages/number_stage.hpp"
#include "pipeline/stages/partner_stage.hpp"
#include "pipeline/stages/picture_stage.hpp"
#include "pipeline/stages/refine_stage.hpp"
#include "pipeline/stages/share_stage.hpp"
#include "pipeline/stages/untangle_and_fill.hpp"
#include "pipeline/stages/verify_stage.hpp"
#include "pipeline/stages/write_stage.hpp"

namespace tessera::pipeline {
namespace {

bool wants_better_seams(const RunResult& run)
{
  return run.resolved.improve.seams && !are_counts_known(run.kernels);
}

// What the jobs start from. Ids that are known before the fills let these write the files.
void load_workers(const RunResult& run, const SharedBytes& mesh, const OutputPlan& output,
                  RunContext& context)
{
  load_mesh(mesh, context);
  if (wants_better_seams(run)) {
    load_improvement(run.resolved, run.kernels, context);
  }
  if (!output.outline.is_one_pass) return;
  load_numbers(output.outline.pieces, output.length_unit, run.resolved.output, context);
}

// From the levels that pieces were filled on to all, or to tets of second order.
void split_pieces(RunResult& run, const subdomain::PartitionedMesh& cut, const OutputPlan& output,
                  RunContext& context)
{
  const RunOutline& outline = output.outline;
  const auto& ranges = outline.has_files ? outline.files : outline.jobs;
  const subdomain::PieceSplit split{outline.is_curved ? 1 : run.splits, outline.is_curved};
  const std::size_t num_limits = run.limiter.entries().size();
  run.filled = run_refine_stage(
      run.resolved, {cut, run.kernels, split, ranges, outline.has_files, output.length_unit},
      run.limiter, std::move(run.filled), context);
  if (outline.is_curved) run.num_straightened = run.limiter.entries().size() - num_limits;
  run_verify_stage(cut, outline.jobs, run.filled, context);
}

}  // namespace

RunResult run_pipeline(const config::Case& given, const RunOptions& options, RunContext& context)
{
  RunResult run = run_coarse_part(given, options, context);  // Model, size, coarse, decompose.
  SharedMesh shared = share_mesh(run, context);
  const subdomain::PartitionedMesh cut(run.coarse.mesh, run.decomposition.decomposition,
                                       std::move(shared.tables));
  const OutputPlan output = plan_output(run, cut, options, context);
  const RunOutline& outline = output.outline;
  load_workers(run, shared.message, output, context);
  require_disk_space(outline, run.resolved.output, context);

  UntangledFill fill =
      untangle_and_fill(run.resolved, {cut, run.kernels, outline.jobs, options.state}, context);
  run.limiter = std::move(fill.limiter);
  run.filled = std::move(fill.filled);
  if (wants_better_seams(run)) {
    run.filled = run_improve_stage(run.resolved, cut, run.kernels, std::move(run.filled), context);
  }
  run_verify_stage(cut, outline.jobs, run.filled, context);
  if (outline.splits_pieces()) split_pieces(run, cut, output, context);

  const number::IdLayout ids = number_mesh(run, cut, outline);
  const auto layers = subdomain::layer_tables(cut.coarse, cut.skeleton,
                                              mesh::lattice_levels(cut.skeleton, cut.levels));
  const subdomain::WriteContext mesh{.coarse = cut.coarse,
                                     .skeleton = cut.skeleton,
                                     .ids = ids,
                                     .length_unit = output.length_unit,
                                     .places_of = places_of_vertices(run, cut),
                                     .layers = layers ? &*layers : nullptr};
  run.num_vertices = mesh.num_vertices();
  run.num_tets = ids.num_tets();
  if (options.on_piece) {
    run_hand_over_stage(outline.files, mesh, options.on_piece, run.filled, context);
    run.drawings = run_picture_stage(run, cut, {}, context);
    return run;
  }
  if (!outline.is_one_pass && !outline.splits_pieces()) {
    run_write_stage(run.resolved, outline.files, mesh, run.filled, context);
  }
  run_partner_stage(run, outline.files, context);
  write_indices(run, outline.files, mesh, context);
  run.drawings = run_picture_stage(run, cut, outline.files, context);
  run.files = run_export_stage(run.resolved, context);
  if (!run.files.empty()) write_indices(run, outline.files, mesh, context);
  return run;
}

}  // namespace tessera::pipeline
