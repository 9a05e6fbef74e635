// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>
#include <vector>

#include "tessera/config/case.hpp"
#include "tessera/decompose/decompose.hpp"
#include "tessera/mesh/projection_limiter.hpp"
#include "tessera/model/model.hpp"

#include "pipeline/runtime/run_context.hpp"
#include "pipeline/stages/coarse_stage.hpp"
#include "pipeline/stages/fill_stage.hpp"
#include "pipeline/stages/hand_over_stage.hpp"
#include "pipeline/store/run_state.hpp"

namespace tessera::pipeline {

/// @brief What a run has made; the same on every rank. The mesh itself is in the output folder.
struct RunResult {
  config::Case resolved{};  ///< With size and levels as chosen.
  double largest_size = std::numeric_limits<double>::infinity();  ///< largest_coarse_size().
  model::ModelSource model{};
  CoarseResult coarse{};
  decompose::DecomposeResult decomposition{};
  std::vector<fill::KernelKind> kernels{};  ///< By subdomain, as the case wants them.
  mesh::ProjectionLimiter limiter{};
  FilledPieces filled{};
  std::vector<LocalIndex> only_subdomains{};  ///< As asked for; empty: all.
  GlobalIndex num_vertices = 0;               ///< Of the whole mesh, made or not.
  GlobalIndex num_tets = 0;
};

/// @brief What a run is told besides its case.
struct RunOptions {
  const RunState* state = nullptr;            ///< Of the output folder; nullptr: keep nothing.
  std::vector<LocalIndex> only_subdomains{};  ///< Ascending; empty: all.
  PieceSink on_piece{};                       ///< If set, gets the pieces: no files are written.
};

/// @brief What each file of the run holds: output.files, or the subdomains asked for. Local.
/// @throws ConfigError if only some subdomains are asked for and that is not possible: part of a
/// mesh has ids only where the number of all other tets is known without making them.
[[nodiscard]] std::vector<subdomain::SubdomainRange> output_ranges(const RunResult& run,
                                                                   const RunOptions& options);

/// @brief Unit of the output's lengths; empty if nobody knows it. Local.
[[nodiscard]] std::string output_length_unit(const RunResult& run);

/// @brief The stages in their order.
/// @note Collective. The worker processes of `context.jobs` are those of make_mesh_worker().
/// @throws what the stages throw, on every rank.
[[nodiscard]] RunResult run_pipeline(const config::Case& given, const RunOptions& options,
                                     RunContext& context);

/// @brief The first stages only, from the model to the subdomains: no fine work.
/// @note Collective.
[[nodiscard]] RunResult run_coarse_part(const config::Case& given, const RunOptions& options,
                                        RunContext& context);

}  // namespace tessera::pipeline
