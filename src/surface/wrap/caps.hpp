// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "tessera/base/vec3.hpp"

#include "surface/wrap/corners.hpp"

namespace tessera::surface {

/// @brief Triangles that close the holes of a surface, each hole by the least area over its rim
/// @cite barequet1995. Local.
///
/// A hole counts if its triangles are farther than a tolerance from the surface, and if winding
/// numbers are about 1/2 there. So a gap between sheets stays, and so does an end that lies within
/// a body or outside of all.
/// @param[in] file Oriented; not empty. Corners are one if their bits are.
[[nodiscard]] std::vector<std::array<Vec3, 3>> hole_caps(const FileTriangles& file,
                                                         double tolerance);

}  // namespace tessera::surface
