// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <nlohmann/json.hpp>

#include "pipeline/store/filled_pieces.hpp"

namespace tessera::pipeline {

using Json = nlohmann::ordered_json;

/// @brief Of all pieces together. Local.
[[nodiscard]] quality::TetStatistics statistics_of_tets(
    const std::vector<subdomain::PieceSummary>& pieces);

/// @brief The block `quality` of report.json. Local.
[[nodiscard]] Json quality_json(const FilledPieces& filled);

}  // namespace tessera::pipeline
