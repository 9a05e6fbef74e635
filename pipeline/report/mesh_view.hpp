// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "pipeline/viewer/view_page.hpp"

namespace tessera::pipeline {

/// @brief What is known of a mesh whose surface is shown.
struct MeshWords {
  std::vector<std::string> patches{};    ///< Names, by row of the files.
  std::vector<std::string> materials{};  ///< Names; entry m-1 is of material m.
  std::string length_unit{};
  std::optional<std::string> report{};  ///< report.json, if there is one.
};

/// @brief The surface of a mesh with names of patches and materials. The report adds areas and
/// numbers of patches, materials of subdomains and the worst tets. Local.
[[nodiscard]] SurfaceView mesh_view(const MeshWords& words, Surface surface);

}  // namespace tessera::pipeline
