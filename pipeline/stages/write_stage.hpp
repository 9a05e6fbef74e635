// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tessera/config/case.hpp"

#include "pipeline/piece_arrays.hpp"
#include "pipeline/run_context.hpp"
#include "pipeline/stages/fill_stage.hpp"

namespace tessera::pipeline {

/// @brief Turns every piece of the store into mesh/piece_NNNNNN.vtu and boundary/piece_NNNNNN.vtu,
/// writes the indices mesh.pvtu and boundary.pvtu, and empties the store.
/// @note Collective.
/// @throws OutputError on every rank (disk full, permission).
/// @return The digest of every piece, shape (num_subdomains), on every rank.
[[nodiscard]] std::vector<Hash128> run_write_stage(const config::Case& run_case,
                                                   const std::vector<PieceSummary>& pieces,
                                                   const WriteContext& mesh, RunContext& context);

}  // namespace tessera::pipeline
