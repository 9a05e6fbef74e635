// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tessera/config/case.hpp"

#include "pipeline/piece_arrays.hpp"
#include "pipeline/run_context.hpp"
#include "pipeline/stages/fill_stage.hpp"

namespace tessera::pipeline {

/// @brief Turns the pieces of the store into mesh/piece_NNNNNN.vtu and boundary/piece_NNNNNN.vtu,
/// one of each a range, and puts their digests into the summaries.
/// @note Collective.
/// @throws OutputError on every rank (disk full, permission).
void run_write_stage(const config::Case& run_case, const std::vector<SubdomainRange>& files,
                     const WriteContext& mesh, FilledPieces& filled, RunContext& context);

/// @brief Writes mesh.pvtu and boundary.pvtu: from now on there is a mesh.
/// @note Collective. @throws OutputError on every rank.
void write_indices(const config::Case& run_case, const std::vector<SubdomainRange>& files,
                   const WriteContext& mesh, const FilledPieces& filled, RunContext& context);

}  // namespace tessera::pipeline
