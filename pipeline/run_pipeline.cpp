// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/run_pipeline.hpp"

#include <string>

#include "tessera/mesh/lattice.hpp"
#include "tessera/mesh/skeleton.hpp"

#include "pipeline/resolve_size.hpp"
#include "pipeline/stages/decompose_stage.hpp"
#include "pipeline/stages/model_stage.hpp"
#include "pipeline/stages/plan_stage.hpp"
#include "pipeline/stages/verify_stage.hpp"
#include "pipeline/stages/write_stage.hpp"

namespace tessera::pipeline {
namespace {

number::IdLayout number_pieces(const mesh::Skeleton& skeleton, int levels,
                               const std::vector<PieceSummary>& pieces)
{
  std::vector<number::PieceCounts> counts;
  for (const PieceSummary& piece : pieces) {
    counts.push_back({piece.num_interior_vertices, piece.num_tets, piece.num_boundary});
  }
  return {mesh::UnitLayout(skeleton), mesh::lattice::intervals(levels), counts};
}

// Of a scaled mesh only the user knows the unit.
std::string output_length_unit(const RunResult& run)
{
  return run.resolved.geometry.scale == 1.0 ? run.model.length_unit : std::string{};
}

}  // namespace

RunResult run_dry(const config::Case& given, RunContext& context)
{
  RunResult run;
  run.model = run_model_stage(given, context);
  run.resolved = resolve_size(given, context);
  run.coarse = run_coarse_stage(run.resolved, context);
  run.decomposition = run_decompose_stage(run.resolved, run.coarse.mesh, context);
  return run;
}

RunResult run_pipeline(const config::Case& given, RunContext& context)
{
  RunResult run = run_dry(given, context);
  const mesh::CoarseMesh& coarse = run.coarse.mesh;
  const mesh::Decomposition& decomposition = run.decomposition.decomposition;
  const mesh::Skeleton skeleton = mesh::build_skeleton(coarse, decomposition);

  run.damping = run_plan_stage(run.resolved, coarse, decomposition, skeleton, context);
  run.filled = run_fill_stage(run.resolved, decomposition, skeleton, context);
  const number::IdLayout ids =
      number_pieces(skeleton, run.resolved.refine.levels, run.filled.pieces);
  run_verify_stage(coarse, decomposition, skeleton, run.filled, context);
  const std::string length_unit = output_length_unit(run);
  run.digests = run_write_stage(run.resolved, run.filled.pieces,
                                {coarse, skeleton, ids, length_unit}, context);
  run.num_vertices = ids.num_vertices();
  run.num_tets = ids.num_tets();
  return run;
}

}  // namespace tessera::pipeline
