// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pipeline/report/json/quality_json.hpp"
#include "pipeline/run_result.hpp"

namespace tessera::pipeline {

/// @brief How much of the walls has layers, by patch, and how many cells these are. @pre The run
/// has layers.
[[nodiscard]] Json layers_json(const RunResult& run);

}  // namespace tessera::pipeline
