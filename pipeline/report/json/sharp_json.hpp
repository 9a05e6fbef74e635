// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tessera/coarse/sharp_tets.hpp"

#include "pipeline/report/json/quality_json.hpp"

namespace tessera::pipeline {

/// @brief The block `coarse.sharp` of report.json: coarse tets below kSharpAngle_deg, and where
/// those are that no sharp angle of the model forces. Local.
[[nodiscard]] Json sharp_json(const coarse::SharpTets& sharp, const mesh::CoarseMesh& coarse);

}  // namespace tessera::pipeline
