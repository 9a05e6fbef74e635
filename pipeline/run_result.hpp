// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>
#include <vector>

#include "tessera/config/case.hpp"
#include "tessera/decompose/decompose.hpp"
#include "tessera/fill/options.hpp"
#include "tessera/mesh/projection_limiter.hpp"
#include "tessera/model/model.hpp"

#include "pipeline/stages/coarse_stage.hpp"
#include "pipeline/stages/hand_over_stage.hpp"
#include "pipeline/store/filled_pieces.hpp"
#include "pipeline/store/run_state.hpp"

namespace tessera::pipeline {

/// @brief What a run is told besides its case.
struct RunOptions {
  const RunState* state = nullptr;            ///< Of the output folder; nullptr: keep nothing.
  std::vector<LocalIndex> only_subdomains{};  ///< Ascending; empty: all.
  PieceSink on_piece{};                       ///< If set, gets the pieces: no files are written.
};

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

}  // namespace tessera::pipeline
