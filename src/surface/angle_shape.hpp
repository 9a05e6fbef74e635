// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "tessera/base/triangle.hpp"

namespace tessera::surface {

/// @brief Sine of the smallest angle of a triangle over that of 60 degrees: 1 for an equilateral
/// triangle, 0 for a flat one.
[[nodiscard]] inline double angle_shape(const std::array<Vec3, 3>& p) noexcept
{
  std::array<double, 3> squares{};
  for (std::size_t c = 0; c < 3; ++c) {
    const Vec3 side = p[(c + 1) % 3] - p[c];
    squares[c] = dot(side, side);
  }
  const double shortest = std::min({squares[0], squares[1], squares[2]});
  const double product = squares[0] * squares[1] * squares[2];
  if (product <= 0.0) return 0.0;
  // The smallest angle is between the two longer sides.
  return norm(normal_of(p)) * std::sqrt(shortest / product) * (2.0 / std::numbers::sqrt3);
}

}  // namespace tessera::surface
