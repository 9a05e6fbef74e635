// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>

#include "tessera/base/triangle.hpp"
#include "tessera/base/types.hpp"
#include "tessera/base/vec3.hpp"

namespace tessera::mesh {

/// @brief Calls `visit(point, place)` for each point of a triangle on a side with images. Its place
/// is half way to the triangle's centre: at a crack that goes to the side there are several points
/// at one position, but a triangle has these places for itself. Local.
/// @param[in] points Corners, and of second order nodes: rows of `xyz`.
template <class Visit>
void for_each_side_place(std::span<const double> xyz, std::span<const LocalIndex> points,
                         const Visit& visit)
{
  const Vec3 centre =
      middle_of({point_at(xyz, points[0]), point_at(xyz, points[1]), point_at(xyz, points[2])});
  for (const LocalIndex point : points) visit(point, midpoint(point_at(xyz, point), centre));
}

}  // namespace tessera::mesh
