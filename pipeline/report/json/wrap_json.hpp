// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "tessera/model/options.hpp"

namespace tessera::pipeline {

/// @brief Block `model.wrap` of report.json. Local.
/// @param[in] scale Output length units per file length unit.
[[nodiscard]] nlohmann::ordered_json wrap_json(const model::Wrap& wrap, double scale);

/// @brief Why a run whose model is a wrap is degraded. Local.
[[nodiscard]] std::string wrap_reason(const model::Wrap& wrap, double scale);

}  // namespace tessera::pipeline
