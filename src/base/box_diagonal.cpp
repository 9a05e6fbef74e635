// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/base/box_diagonal.hpp"

#include <algorithm>

#include "tessera/base/vec3.hpp"

namespace tessera {

std::array<Vec3, 2> bounding_box(std::span<const double> xyz)
{
  Vec3 low = point_at(xyz, 0);
  Vec3 high = low;
  for (std::size_t i = 0; i < xyz.size() / 3; ++i) {
    const Vec3 point = point_at(xyz, i);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], point[axis]);
      high[axis] = std::max(high[axis], point[axis]);
    }
  }
  return {low, high};
}

double box_diagonal(std::span<const double> xyz)
{
  if (xyz.empty()) return 0.0;
  const auto [low, high] = bounding_box(xyz);
  return norm(high - low);
}

}  // namespace tessera
