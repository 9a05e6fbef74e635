// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <initializer_list>

#include <TopoDS_Shape.hxx>

namespace tessera::testing {

/// @brief A shaft, a ring, and balls at these angles that run in grooves of both: each touches a
///        groove along half a circle, with one normal. A block stands on the shaft.
[[nodiscard]] TopoDS_Shape bearing(std::initializer_list<double> angles);

/// @brief Two boxes of size 1 that have next to nothing in common.
[[nodiscard]] TopoDS_Shape overlapping_boxes(double overlap);

/// @brief The space between a plane and a cylinder that lies on it.
[[nodiscard]] TopoDS_Shape cusp();

/// @brief A block with rounded edges. NETGEN alone makes edges half as long as small radii along
///        all of it.
[[nodiscard]] TopoDS_Shape rounded_block(double radius);

/// @brief A shaft of radius 20 with a shoulder: a ledge between two circles.
[[nodiscard]] TopoDS_Shape shoulder(double ledge);

}  // namespace tessera::testing
