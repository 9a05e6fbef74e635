// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tessera/model/assembly.hpp"

#include "pipeline/report/json/quality_json.hpp"

namespace tessera::pipeline {

/// @brief What was found where solids meet, as in report.json and `tessera info --json`. Local.
[[nodiscard]] Json assembly_json(const model::Assembly& assembly);

}  // namespace tessera::pipeline
