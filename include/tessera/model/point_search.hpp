// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <span>
#include <vector>

#include "tessera/model/nearest_point.hpp"

namespace tessera::model {

/// @brief Search for the nearest of some points, which are segments without length:
/// NearestPoint::simplex is its row. Local. @pre points is not empty.
[[nodiscard]] inline SegmentSearch search_of_points(std::span<const Vec3> points)
{
  std::vector<std::array<Vec3, 2>> segments;
  segments.reserve(points.size());
  for (const Vec3& point : points) segments.push_back({point, point});
  return SegmentSearch(segments);
}

}  // namespace tessera::model
