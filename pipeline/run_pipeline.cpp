// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/run_pipeline.hpp"

#include <functional>
#include <optional>
#include <string>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "tessera/base/error.hpp"
#include "tessera/base/hash.hpp"
#include "tessera/comm/all_or_none.hpp"
#include "tessera/fill/fallbacks.hpp"
#include "tessera/mesh/lattice.hpp"
#include "tessera/subdomain/count_pieces.hpp"

#include "pipeline/estimate/disk_space.hpp"
#include "pipeline/estimate/only_subdomains.hpp"
#include "pipeline/estimate/run_outline.hpp"
#include "pipeline/runtime/with_file_context.hpp"
#include "pipeline/stages/decompose_stage.hpp"
#include "pipeline/stages/improve_stage.hpp"
#include "pipeline/stages/load_stage.hpp"
#include "pipeline/stages/model_stage.hpp"
#include "pipeline/stages/size_stage.hpp"
#include "pipeline/stages/untangle_and_fill.hpp"
#include "pipeline/stages/verify_stage.hpp"
#include "pipeline/stages/write_stage.hpp"
#include "pipeline/store/improved_pieces.hpp"

namespace tessera::pipeline {
namespace {

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

// What the store keeps of a run before it fills.
struct CutCoarseMesh {
  CoarseResult coarse{};
  decompose::DecomposeResult decomposition{};

  static auto fields(auto& self) { return std::tie(self.coarse, self.decomposition); }
};

// Coarse mesh and subdomains: from the folder of a run that was stopped, or made and kept there.
void cut_coarse_mesh(RunResult& run, double target, const RunOptions& options, RunContext& context)
{
  auto kept = on_root(context.comm, [&]() -> std::optional<CutCoarseMesh> {
    const auto record = options.state == nullptr ? std::nullopt : options.state->find_coarse();
    return record ? std::optional(from_bytes<CutCoarseMesh>(*record)) : std::nullopt;
  });
  if (kept) {
    run.coarse = std::move(kept->coarse);
    run.decomposition = std::move(kept->decomposition);
    return;
  }
  run.coarse = run_coarse_stage(run.resolved, context);
  if (target > 0.0) refit_coarse_mesh(run, target, context);
  run.decomposition = run_decompose_stage(run.resolved, run.coarse.mesh, context);
  all_or_none(context.comm, [&] {
    if (options.state == nullptr || context.comm.rank() != 0) return;
    options.state->keep_coarse(to_bytes(CutCoarseMesh{run.coarse, run.decomposition}));
  });
}

// Ids of vertices follow from closed forms, unless pieces have exchanged tets.
number::IdLayout number_mesh(const subdomain::PartitionedMesh& cut, int levels,
                             const RunOutline& outline, const FilledPieces& filled)
{
  if (filled.improvement.generation > 0) {
    return number::IdLayout::by_owner(subdomain::counts_of(filled.pieces));
  }
  return number::IdLayout::by_host(
      mesh::HostLayout(cut.skeleton), mesh::lattice::intervals(levels),
      are_counts_known(outline.kernels) ? outline.pieces : subdomain::counts_of(filled.pieces));
}

// Who owns which vertex, once pieces have exchanged tets.
std::function<std::vector<subdomain::VertexPlace>(const mesh::Piece&)> places_of_vertices(
    const subdomain::PartitionedMesh& cut, const FilledPieces& filled, const RunContext& context)
{
  const int generation = filled.improvement.generation;
  if (generation == 0) return {};
  return [pieces = ImprovedPieces(context.folder, cut.skeleton, generation)](
             const mesh::Piece& piece) { return pieces.places_of(piece); };
}

}  // namespace

// Of a scaled mesh only the user knows the unit.
std::string output_length_unit(const RunResult& run)
{
  return run.resolved.geometry.scale == 1.0 ? run.model.length_unit : std::string{};
}

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

RunResult run_coarse_part(const config::Case& given, const RunOptions& options, RunContext& context)
{
  RunResult run;
  run.model = run_model_stage(given, context);
  all_or_none(context.comm, [&] {
    if (options.state == nullptr || context.comm.rank() != 0) return;
    options.state->require_same_run(hash_bytes(run.model.content));
  });
  run.resolved = resolve_size(given, context);
  run.largest_size = largest_coarse_size(given.size.target, run.resolved.refine.levels);
  cut_coarse_mesh(run, given.size.target, options, context);
  all_or_none(context.comm, [&] {
    run.kernels = fill::kernels_of(run.resolved.fill, run.coarse.mesh.material_names,
                                   run.decomposition.decomposition.subdomain_material);
  });
  return run;
}

RunResult run_pipeline(const config::Case& given, const RunOptions& options, RunContext& context)
{
  RunResult run = run_coarse_part(given, options, context);
  const subdomain::PartitionedMesh cut(run.coarse.mesh, run.decomposition.decomposition);
  std::vector<subdomain::SubdomainRange> files;
  all_or_none(context.comm,
              [&] { with_file_context(given, [&] { files = output_ranges(run, options); }); });
  RunOutline outline =
      outline_run(cut, run.kernels, run.resolved.refine.levels, files, run.resolved.improve.seams);
  if (options.on_piece) outline.hand_over_pieces();
  all_or_none(context.comm, [&] {
    with_file_context(given, [&] {
      if (const auto defect = file_too_large(outline, run.resolved)) throw ConfigError(*defect);
    });
  });
  const bool is_one_pass = outline.is_one_pass;
  const std::string length_unit = output_length_unit(run);

  const int levels = run.resolved.refine.levels;
  load_mesh(cut, levels, run.largest_size, context);
  // Ids that are known before the fills let the fills write the files themselves.
  if (is_one_pass) load_numbers(outline.pieces, length_unit, run.resolved.output, context);
  require_disk_space(outline, run.resolved.output, context);

  UntangledFill fill =
      untangle_and_fill(run.resolved, {cut, run.kernels, outline.jobs, options.state}, context);
  run.filled = std::move(fill.filled);
  run.limiter = std::move(fill.limiter);
  if (!are_counts_known(run.kernels) && run.resolved.improve.seams) {
    run.filled = run_improve_stage(run.resolved, cut, run.kernels, std::move(run.filled), context);
  }
  run_verify_stage(cut, outline.jobs, run.filled, context);
  const number::IdLayout ids = number_mesh(cut, levels, outline, run.filled);
  const subdomain::WriteContext mesh{cut.coarse, cut.skeleton, ids, length_unit,
                                     places_of_vertices(cut, run.filled, context)};
  if (options.on_piece) {
    run_hand_over_stage(files, mesh, options.on_piece, run.filled, context);
  } else {
    if (!is_one_pass) run_write_stage(run.resolved, files, mesh, run.filled, context);
    write_indices(run.resolved, files, mesh, run.filled, context);
  }
  run.only_subdomains = options.only_subdomains;
  run.num_vertices = ids.num_vertices();
  run.num_tets = ids.num_tets();
  return run;
}

}  // namespace tessera::pipeline
