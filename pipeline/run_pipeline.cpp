// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/run_pipeline.hpp"

#include <utility>
#include <vector>

#include <fmt/format.h>

#include "tessera/base/error.hpp"
#include "tessera/comm/all_or_none.hpp"
#include "tessera/subdomain/partitioned_mesh.hpp"

#include "pipeline/estimate/disk_space.hpp"
#include "pipeline/run_plan.hpp"
#include "pipeline/runtime/with_file_context.hpp"
#include "pipeline/stages/coarse/coarse_part.hpp"
#include "pipeline/stages/fill/improve_stage.hpp"
#include "pipeline/stages/fill/load_stage.hpp"
#include "pipeline/stages/fill/refine_stage.hpp"
#include "pipeline/stages/fill/share_stage.hpp"
#include "pipeline/stages/fill/untangle_and_fill.hpp"
#include "pipeline/stages/fill/verify_stage.hpp"
#include "pipeline/stages/output/export_stage.hpp"
#include "pipeline/stages/output/number_stage.hpp"
#include "pipeline/stages/output/partner_stage.hpp"
#include "pipeline/stages/output/picture_stage.hpp"
#include "pipeline/stages/output/write_stage.hpp"

namespace tessera::pipeline {
namespace {

void require_files_possible(const RunOutline& outline, const config::Case& resolved,
                            const RunContext& context)
{
  all_or_none(context.comm, [&] {
    with_file_context(resolved, [&] {
      if (const auto defect = file_too_large(outline, resolved)) throw ConfigError(*defect);
    });
  });
}

// What the jobs start from. Ids that are known before the fills let these write the files.
void load_workers(const RunResult& run, const SharedBytes& mesh, const RunPlan& plan,
                  RunContext& context)
{
  load_mesh(mesh, context);
  if (plan.has(Stage::improve)) load_improvement(run.resolved, run.kernels, context);
  if (!plan.outline.is_one_pass) return;
  load_numbers(plan.outline.pieces, plan.length_unit, run.resolved.output, context);
}

void take(LimitedPieces made, RunResult& run)
{
  run.filled = std::move(made.filled);
  run.limiter = std::move(made.limiter);
}

void take(const std::vector<Hash128>& digests, RunResult& run)
{
  for (std::size_t s = 0; s < digests.size(); ++s) run.filled.pieces[s].digest = digests[s];
}

// From the levels that pieces were filled on to all, or to tets of second order.
void split_pieces(RunResult& run, const subdomain::PartitionedMesh& cut, const RunPlan& plan,
                  RunContext& context)
{
  const RunOutline& outline = plan.outline;
  const auto& ranges = outline.has_files ? outline.files : outline.jobs;
  const subdomain::PieceSplit split{outline.is_curved ? 1 : run.splits, outline.is_curved};
  const std::size_t num_limits = run.limiter.entries().size();
  take(run_refine_stage(run.resolved,
                        {cut, run.kernels, split, ranges, outline.has_files, plan.length_unit},
                        {std::move(run.filled), std::move(run.limiter)}, context),
       run);
  if (outline.is_curved) run.num_straightened = run.limiter.entries().size() - num_limits;
  run_verify_stage(cut, outline.jobs, run.filled, context);
}

// All pieces are there, in the store or in files.
void deliver(RunResult& run, const subdomain::PartitionedMesh& cut, const RunPlan& plan,
             const subdomain::WriteContext& mesh, const PieceSink& on_piece, RunContext& context)
{
  const std::vector<subdomain::SubdomainRange>& files = plan.outline.files;
  if (plan.has(Stage::hand_over)) {
    take(run_hand_over_stage(files, mesh, on_piece, run.filled, context), run);
  }
  if (plan.has(Stage::write)) {
    take(run_write_stage(run.resolved, files, mesh, run.filled, context), run);
  }
  if (plan.has(Stage::partners)) run_partner_stage(run, files, context);
  if (plan.outline.has_files) write_indices(run, files, mesh, context);
  if (plan.has(Stage::pictures)) {
    run.drawings = run_picture_stage(run, cut, plan.files_to_draw(), context);
  }
  if (!plan.has(Stage::export_formats) && !plan.has(Stage::neighbours)) return;
  run.files = run_export_stage(run.resolved, context);
  write_indices(run, files, mesh, context);  // Now it is known which files share points.
}

}  // namespace

RunResult run_pipeline(const config::Case& given, const RunOptions& options, RunContext& context)
{
  RunResult run = run_coarse_part(given, options, context);  // Model, size, coarse, decompose.
  SharedMesh shared = share_mesh(run, context);
  const subdomain::PartitionedMesh cut(run.coarse.mesh, run.decomposition.decomposition,
                                       std::move(shared.tables));
  const RunPlan plan = plan_run(run, cut, options, context);
  const RunOutline& outline = plan.outline;
  context.log.debug(fmt::format("stages: {}", text_of(plan.stages)));
  require_files_possible(outline, run.resolved, context);
  load_workers(run, shared.message, plan, context);
  require_disk_space(outline, run.resolved.output, context);

  take(untangle_and_fill(run.resolved, {cut, run.kernels, outline.jobs, options.state}, context),
       run);
  if (plan.has(Stage::improve)) {
    run.filled = run_improve_stage(run.resolved, cut, run.kernels, std::move(run.filled), context);
  }
  run_verify_stage(cut, outline.jobs, run.filled, context);
  if (outline.splits_pieces()) split_pieces(run, cut, plan, context);

  const NumberedMesh numbered = run_number_stage(run, cut, outline);
  const subdomain::WriteContext mesh = write_context(numbered, cut, plan.length_unit);
  run.num_vertices = mesh.num_vertices();
  run.num_tets = numbered.ids.num_tets();
  deliver(run, cut, plan, mesh, options.on_piece, context);
  return run;
}

}  // namespace tessera::pipeline
