// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "tessera/base/vec3.hpp"
#include "tessera/model/triangle_surface.hpp"

namespace tessera::surface {

/// @brief The triangles of a surface that may be open, turned so that winding numbers tell inside
/// from outside. Local.
///
/// Triangles that share an edge with nobody else agree; so they make *sheets*. Of each sheet the
/// larger part by area keeps its side. Then sheets are turned as a whole, the largest one first: a
/// closed one that lies in nothing so that its volume is positive, an open one as the sheets before
/// it say, whose winding numbers fall from its back to its front. Where these say nothing, one that
/// is bent looks out of its hollow, and a flat one stays.
[[nodiscard]] std::vector<std::array<Vec3, 3>> oriented_triangles(
    const model::TriangleSurface& surface);

}  // namespace tessera::surface
