// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <tuple>

#include "tessera/base/vec3.hpp"

namespace tessera {

/// @brief A box along the axes. As it begins it is empty and touches nothing.
struct Box {
  Vec3 low = kNoPoint;
  Vec3 high = -1.0 * kNoPoint;

  constexpr void include(const Vec3& point) noexcept { include({point, point}); }
  constexpr void include(const Box& other) noexcept
  {
    for (std::size_t d = 0; d < 3; ++d) {
      low[d] = std::min(low[d], other.low[d]);
      high[d] = std::max(high[d], other.high[d]);
    }
  }
  [[nodiscard]] constexpr bool is_empty() const noexcept { return low[0] > high[0]; }
  [[nodiscard]] constexpr bool holds(const Vec3& point) const noexcept
  {
    return holds({point, point});
  }
  [[nodiscard]] constexpr bool holds(const Box& other) const noexcept
  {
    return low[0] <= other.low[0] && low[1] <= other.low[1] && low[2] <= other.low[2]
           && other.high[0] <= high[0] && other.high[1] <= high[1] && other.high[2] <= high[2];
  }
  [[nodiscard]] constexpr bool touches(const Box& other) const noexcept
  {
    return low[0] <= other.high[0] && other.low[0] <= high[0] && low[1] <= other.high[1]
           && other.low[1] <= high[1] && low[2] <= other.high[2] && other.low[2] <= high[2];
  }

  [[nodiscard]] constexpr Vec3 extent() const noexcept { return high - low; }
  [[nodiscard]] double diagonal() const noexcept { return norm(extent()); }
  /// @brief The axis of the longest side; of equal ones the first.
  [[nodiscard]] constexpr std::size_t longest_axis() const noexcept
  {
    const Vec3 sides = extent();
    return static_cast<std::size_t>(std::ranges::max_element(sides) - sides.begin());
  }
  /// @brief With all that is so near to it along the axes.
  [[nodiscard]] constexpr Box widened(double by) const noexcept
  {
    const Vec3 margin{by, by, by};
    return {low - margin, high + margin};
  }
  /// @brief 0 if it holds the point. Rounding never makes it more than that of a point it holds.
  [[nodiscard]] constexpr double squared_distance(const Vec3& point) const noexcept
  {
    return squared_gap({point, point});
  }
  /// @brief 0 if they touch. @pre Neither is empty.
  [[nodiscard]] constexpr double squared_gap(const Box& other) const noexcept
  {
    double sum = 0.0;
    for (std::size_t d = 0; d < 3; ++d) {
      const double outside = std::max({low[d] - other.high[d], other.low[d] - high[d], 0.0});
      sum += outside * outside;
    }
    return sum;
  }

  static auto fields(auto& self) { return std::tie(self.low, self.high); }
};

/// @brief The box of a few points: a triangle, a segment. Local.
template <std::size_t N>
[[nodiscard]] constexpr Box box_of(const std::array<Vec3, N>& points) noexcept
{
  Box box{points[0], points[0]};
  for (std::size_t i = 1; i < N; ++i) box.include(points[i]);
  return box;
}

/// @brief The smallest box that holds all points. Local.
/// @param[in] xyz Shape (n, 3).
[[nodiscard]] Box bounding_box(std::span<const double> xyz);
[[nodiscard]] Box bounding_box(std::span<const Vec3> points);

/// @brief Its diagonal; 0 without any point. Local.
/// @param[in] xyz Shape (n, 3).
[[nodiscard]] double box_diagonal(std::span<const double> xyz);

}  // namespace tessera
