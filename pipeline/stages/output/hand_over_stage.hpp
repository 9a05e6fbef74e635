// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <vector>

#include "tessera/subdomain/piece_arrays.hpp"
#include "tessera/subdomain/piece_file.hpp"

#include "pipeline/runtime/run_context.hpp"
#include "pipeline/stages/fill/fill_stage.hpp"

namespace tessera::pipeline {

/// @brief Takes what the files of one number would hold. Called in the process's main thread.
using PieceSink = std::function<void(LocalIndex number, subdomain::PieceArrays piece)>;

/// @brief In place of the write stage: hands every piece of the store to `on_piece` of the rank
/// that takes it.
/// @return Digests of the pieces, as `filled` has these.
/// @note Collective; which rank gets which piece is not determined.
/// @throws OutputError on every rank if `on_piece` throws anything on any.
[[nodiscard]] std::vector<Hash128> run_hand_over_stage(
    const std::vector<subdomain::SubdomainRange>& files, const subdomain::WriteContext& mesh,
    const PieceSink& on_piece, const FilledPieces& filled, RunContext& context);

}  // namespace tessera::pipeline
