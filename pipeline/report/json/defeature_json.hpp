// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pipeline/report/json/quality_json.hpp"
#include "pipeline/stages/coarse/coarse_stage.hpp"

namespace tessera::pipeline {

/// @brief The block `coarse.defeatured` of report.json: what of the model was merged. Local.
[[nodiscard]] Json defeatured_json(const CoarseResult& coarse);

}  // namespace tessera::pipeline
