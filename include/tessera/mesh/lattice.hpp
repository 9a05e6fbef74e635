// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>

#include "tessera/base/types.hpp"

/// @brief Closed forms of the lattices that L levels of splitting put on coarse edges and
/// triangles.
///
/// With n = 2^L, an edge (v0 < v1) carries points 0…n from v0 to v1. A triangle (v0 < v1 < v2)
/// carries points (i, j) with i, j >= 0 and i + j <= n: i steps towards v1 and j towards v2.
/// *Inner* points lie on no end point or side. Level l has the step s = 2^(L-l). A point that it
/// adds is the midpoint of exactly one pair of older points, the same pair seen from everywhere.
namespace tessera::mesh::lattice {

/// @brief Largest number of levels: keeps every count of one coarse entity within LocalIndex.
inline constexpr int kMaxLevels = 10;

/// @brief Intervals of an edge: n = 2^levels. @pre 0 <= levels <= kMaxLevels.
[[nodiscard]] constexpr LocalIndex intervals(int levels) noexcept
{
  return LocalIndex{1} << levels;
}

[[nodiscard]] constexpr LocalIndex num_triangle_points(LocalIndex n) noexcept
{
  return (n + 1) * (n + 2) / 2;
}

[[nodiscard]] constexpr LocalIndex num_inner_edge_points(LocalIndex n) noexcept { return n - 1; }

[[nodiscard]] constexpr LocalIndex num_inner_triangle_points(LocalIndex n) noexcept
{
  return (n - 1) * (n - 2) / 2;
}

/// @brief Place of point (i, j) among all points of a triangle: rows of constant j.
[[nodiscard]] constexpr LocalIndex triangle_index(LocalIndex n, LocalIndex i, LocalIndex j) noexcept
{
  return j * (n + 1) - j * (j - 1) / 2 + i;
}

/// @brief Place of inner point (i, j) among the inner points. @pre i, j >= 1 and i + j <= n - 1.
[[nodiscard]] constexpr LocalIndex inner_triangle_index(LocalIndex n, LocalIndex i,
                                                        LocalIndex j) noexcept
{
  return triangle_index(n - 3, i - 1, j - 1);
}

/// @brief A point (i, j) of a triangle's lattice.
struct TrianglePoint {
  LocalIndex i = 0;
  LocalIndex j = 0;
};

/// @brief Where a point of a triangle lies.
struct PointPlace {
  enum class Part { corner, side, inside };
  Part part = Part::inside;
  std::size_t row = 0;   ///< Of the corner or side.
  LocalIndex steps = 0;  ///< On a side: k of side_point().
};

[[nodiscard]] constexpr PointPlace place_of(LocalIndex n, const TrianglePoint& p) noexcept
{
  using Part = PointPlace::Part;
  if (p.i + p.j == 0) return {Part::corner, 0};
  if (p.i == n) return {Part::corner, 1};
  if (p.j == n) return {Part::corner, 2};
  if (p.j == 0) return {Part::side, 0, p.i};
  if (p.i == 0) return {Part::side, 1, p.j};
  if (p.i + p.j == n) return {Part::side, 2, p.j};
  return {};
}

/// @brief A triangle between three points of a lattice.
struct SmallTriangle {
  TrianglePoint a{};
  TrianglePoint b{};
  TrianglePoint c{};

  /// @brief Point p of its own lattice with `parts` intervals, in the lattice of its corners with
  /// `parts` times as many intervals.
  [[nodiscard]] constexpr TrianglePoint point(LocalIndex parts,
                                              const TrianglePoint& p) const noexcept
  {
    return {parts * a.i + p.i * (b.i - a.i) + p.j * (c.i - a.i),
            parts * a.j + p.i * (b.j - a.j) + p.j * (c.j - a.j)};
  }
};

/// @brief The inner point at a place: the inverse of inner_triangle_index().
[[nodiscard]] constexpr TrianglePoint inner_triangle_point(LocalIndex n, LocalIndex index) noexcept
{
  LocalIndex j = 1;
  for (; index >= n - 1 - j; ++j) index -= n - 1 - j;
  return {index + 1, j};
}

/// @brief Point k of side `side` of a triangle, counted from the side's lower vertex. Side 0 joins
/// v0 v1, side 1 joins v0 v2, side 2 joins v1 v2.
[[nodiscard]] constexpr TrianglePoint side_point(LocalIndex n, std::size_t side,
                                                 LocalIndex k) noexcept
{
  if (side == 0) return {k, 0};
  if (side == 1) return {0, k};
  return {n - k, k};
}

/// @brief The two older points whose midpoint a new point is, `step` = its level's spacing.
/// @pre the point is new at that level: exactly two of (i, j, n - i - j) are odd multiples of step.
[[nodiscard]] constexpr std::array<TrianglePoint, 2> parents(const TrianglePoint& point,
                                                             LocalIndex step) noexcept
{
  const bool i_is_odd = (point.i / step) % 2 != 0;
  const bool j_is_odd = (point.j / step) % 2 != 0;
  const LocalIndex di = i_is_odd ? step : 0;
  const LocalIndex dj = j_is_odd ? (i_is_odd ? -step : step) : 0;
  return {TrianglePoint{point.i - di, point.j - dj}, TrianglePoint{point.i + di, point.j + dj}};
}

/// @brief Calls visit(a, b, c) for each of the n^2 small triangles, all oriented as (v0, v1, v2);
/// a, b, c are TrianglePoints `step` apart. @pre step divides n.
template <class Visit>
constexpr void for_each_small_triangle(LocalIndex n, LocalIndex step, Visit&& visit)
{
  for (LocalIndex j = 0; j < n; j += step) {
    for (LocalIndex i = 0; i + j < n; i += step) {
      visit(TrianglePoint{i, j}, TrianglePoint{i + step, j}, TrianglePoint{i, j + step});
      if (i + j + 2 * step > n) continue;
      visit(TrianglePoint{i + step, j}, TrianglePoint{i + step, j + step},
            TrianglePoint{i, j + step});
    }
  }
}

}  // namespace tessera::mesh::lattice
