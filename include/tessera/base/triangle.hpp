// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <span>

#include "tessera/base/vec3.hpp"

namespace tessera {

/// @brief Points to where the corners run anticlockwise; twice as long as the triangle's area.
[[nodiscard]] constexpr Vec3 normal_of(const std::array<Vec3, 3>& p) noexcept
{
  return cross(p[1] - p[0], p[2] - p[0]);
}

/// @brief Of length 1; zero if the triangle has no area.
[[nodiscard]] inline Vec3 unit_normal_of(const std::array<Vec3, 3>& p) noexcept
{
  return unit(normal_of(p));
}

[[nodiscard]] inline double triangle_area(const std::array<Vec3, 3>& p) noexcept
{
  return triangle_area(p[0], p[1], p[2]);
}

/// @brief Mean of the corners.
[[nodiscard]] constexpr Vec3 middle_of(const std::array<Vec3, 3>& p) noexcept
{
  return (1.0 / 3.0) * (p[0] + p[1] + p[2]);
}

[[nodiscard]] inline double longest_side(const std::array<Vec3, 3>& p) noexcept
{
  return std::max({norm(p[1] - p[0]), norm(p[2] - p[1]), norm(p[0] - p[2])});
}

/// @brief Centroid of a surface; not finite if it has no area. Local.
[[nodiscard]] inline Vec3 centroid_of(std::span<const std::array<Vec3, 3>> triangles) noexcept
{
  Vec3 sum{};
  double area = 0.0;
  for (const auto& [a, b, c] : triangles) {
    const double of_triangle = triangle_area(a, b, c);
    sum = sum + (of_triangle / 3.0) * (a + b + c);
    area += of_triangle;
  }
  return (1.0 / area) * sum;
}

}  // namespace tessera
