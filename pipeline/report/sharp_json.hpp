// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "tessera/coarse/sharp_tets.hpp"

#include "pipeline/report/quality_json.hpp"

namespace tessera::pipeline {

/// @brief Coarse tets with a smaller angle than this are named.
inline constexpr double kSharpAngle_deg = 5.0;

/// @brief The block `coarse.sharp` of report.json: coarse tets below kSharpAngle_deg, and where
/// those are that no sharp angle of the model forces. Local.
[[nodiscard]] Json sharp_json(const coarse::SharpTets& sharp, const mesh::CoarseMesh& coarse);

/// @brief What to say if there are such tets. Local.
[[nodiscard]] std::optional<std::string> sharp_warning(const coarse::SharpTets& sharp);

}  // namespace tessera::pipeline
