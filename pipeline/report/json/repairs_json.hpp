// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pipeline/report/json/quality_json.hpp"
#include "pipeline/run_result.hpp"

namespace tessera::pipeline {

/// @brief The block `repairs` of report.json: how often each repair has changed something in what
/// became the mesh, by name; none that has not. And `left_out`, if something is. Local.
[[nodiscard]] Json repairs_json(const RunResult& run);

}  // namespace tessera::pipeline
