// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "pipeline/viewer/surface.hpp"

namespace tessera::pipeline {

/// @brief A surface with all that its page says of it.
struct SurfaceView {
  Surface surface{};
  /// What web/viewer.js reads: "kind" ("mesh", "model", "places"), "unit", "faces" (by row of the
  /// surface's "face"), "colourings", "worst" (marks), and of a model more. Colours and layout are
  /// added.
  nlohmann::ordered_json description{};
};

/// @brief The view as part of a page, to turn and to point at: HTML with all that it needs, or, if
/// three.js is not installed or there is nothing to show, why there is none. Local.
[[nodiscard]] std::string view_html(const SurfaceView& view);

}  // namespace tessera::pipeline
