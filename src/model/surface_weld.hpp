// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "tessera/model/stl_file.hpp"
#include "tessera/model/triangle_surface.hpp"

namespace tessera::model {

/// @brief Gives corners with the same bits one vertex, numbered by first appearance.
/// @return The surface with solids, without materials; nothing about it is checked.
[[nodiscard]] TriangleSurface weld_equal_corners(const TriangleSoup& soup);

/// @brief Joins vertices of open edges that are within `tolerance` of each other, directly or in a
/// chain; the lowest number stays.
/// @return How many vertices were joined to another.
LocalIndex weld_open_vertices(TriangleSurface& surface, double tolerance);

struct DroppedTriangles {
  LocalIndex degenerate = 0;  ///< Fewer than three different vertices.
  LocalIndex repeated = 0;    ///< The three vertices of an earlier triangle, in any order.
  /// A place in each body that had no size: some triangles that hang together, all degenerate.
  std::vector<Vec3> bodies{};
};

/// @brief Removes triangles that cannot be part of a surface, and vertices then unused.
DroppedTriangles drop_bad_triangles(TriangleSurface& surface);

}  // namespace tessera::model
