// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include <fmt/format.h>

#include "tessera/base/vec3.hpp"

namespace tessera::sizing {

/// @brief The box around points, along the axes. Without points it is far from everything.
struct Bounds {
  Vec3 low{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(),
           std::numeric_limits<double>::infinity()};
  Vec3 high{-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(),
            -std::numeric_limits<double>::infinity()};

  void include(const Vec3& point) noexcept
  {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], point[axis]);
      high[axis] = std::max(high[axis], point[axis]);
    }
  }

  [[nodiscard]] double distance(const Vec3& point) const noexcept
  {
    double sum = 0.0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double outside = std::max({low[axis] - point[axis], point[axis] - high[axis], 0.0});
      sum += outside * outside;
    }
    return std::sqrt(sum);
  }

  [[nodiscard]] bool meets(const Bounds& other) const noexcept
  {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (low[axis] > other.high[axis] || other.low[axis] > high[axis]) return false;
    }
    return true;
  }
};

/// @brief "(0, 0, 0) to (1, 2, 3)".
[[nodiscard]] inline std::string to_text(const Bounds& box)
{
  return fmt::format("({:.6g}, {:.6g}, {:.6g}) to ({:.6g}, {:.6g}, {:.6g})", box.low[0], box.low[1],
                     box.low[2], box.high[0], box.high[1], box.high[2]);
}

}  // namespace tessera::sizing
