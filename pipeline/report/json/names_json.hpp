// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pipeline/report/json/quality_json.hpp"
#include "pipeline/run_result.hpp"

namespace tessera::pipeline {

/// @brief Adds what the mesh has under each name: the blocks `patch_names`, `patches` and
/// `materials` of report.json. Local.
void add_names(Json& json, const RunResult& run);

}  // namespace tessera::pipeline
