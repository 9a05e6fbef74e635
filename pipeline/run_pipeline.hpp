// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "tessera/base/hash.hpp"
#include "tessera/config/case.hpp"
#include "tessera/decompose/decompose.hpp"
#include "tessera/mesh/damping.hpp"
#include "tessera/model/model.hpp"
#include "tessera/number/id_layout.hpp"

#include "pipeline/run_context.hpp"
#include "pipeline/stages/coarse_stage.hpp"
#include "pipeline/stages/fill_stage.hpp"

namespace tessera::pipeline {

/// @brief What a run has made; the same on every rank. The mesh itself is in the output folder.
struct RunResult {
  config::Case resolved{};  ///< With size and levels as chosen.
  model::ModelSource model{};
  CoarseResult coarse{};
  decompose::DecomposeResult decomposition{};
  mesh::Damping damping{};
  FilledPieces filled{};
  std::vector<Hash128> digests{};  ///< By subdomain.
  GlobalIndex num_vertices = 0;
  GlobalIndex num_tets = 0;
};

/// @brief The stages in their order.
/// @note Collective. The worker processes of `context.jobs` are those of make_mesh_worker().
/// @throws what the stages throw, on every rank.
[[nodiscard]] RunResult run_pipeline(const config::Case& given, RunContext& context);

/// @brief The first stages only: what a run would make, without any fine work.
[[nodiscard]] RunResult run_dry(const config::Case& given, RunContext& context);

}  // namespace tessera::pipeline
