// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pipeline/report/json/quality_json.hpp"
#include "pipeline/run_result.hpp"

namespace tessera::pipeline {

/// @brief For the block `decompose` of report.json: the planes that cut the model, and its parts.
/// Lengths are in the output length unit. Local.
[[nodiscard]] Json cuts_json(const RunResult& run);

}  // namespace tessera::pipeline
