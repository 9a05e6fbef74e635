// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "tessera/model/triangle_surface.hpp"

namespace tessera::model {

/// @brief What mend_flat_triangles() has done.
struct MendedTriangles {
  LocalIndex num_steps = 0;
  std::vector<LocalIndex> gone{};  ///< Ascending; as they were numbered before.
};

/// @brief Takes triangles out of a closed surface that are flatter than `height`: their short edge
/// is collapsed, or the vertex on their longest edge goes into that edge. Folds that enclose
/// nothing are unfolded: two triangles at an edge that lie in each other. No vertex moves farther
/// than `height` at a time. Local.
///
/// A triangle stays where the surface would not have two triangles at each edge without it.
/// @pre Triangles agree with their neighbours (orient()).
MendedTriangles mend_flat_triangles(TriangleSurface& surface, double height);

}  // namespace tessera::model
