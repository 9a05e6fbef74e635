// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>

#include "tessera/base/types.hpp"

/// @brief Closed forms of the lattice that L levels of 8-way splitting put into a coarse tet.
///
/// Points are (i, j, k), i, j, k >= 0, i + j + k <= n: steps towards corners 1, 2 and 3. All n^3
/// children come from three shapes: upright tets, octahedra cut into four along one diagonal, and
/// tets upside down. One choice of diagonal for all levels of a coarse tet is Bey's ordering: at
/// most three similarity classes.
/// @cite bey1995tetrahedral  Bey, Computing 55 (1995) 355-378.
namespace tessera::mesh::lattice {

/// @brief A point (i, j, k) of a tet's lattice.
struct TetPoint {
  LocalIndex i = 0;
  LocalIndex j = 0;
  LocalIndex k = 0;
};

[[nodiscard]] constexpr LocalIndex num_tet_points(LocalIndex n) noexcept
{
  return (n + 1) * (n + 2) / 2 * (n + 3) / 3;
}

/// @brief Points on none of the four faces.
[[nodiscard]] constexpr LocalIndex num_inner_tet_points(LocalIndex n) noexcept
{
  return n < 4 ? 0 : num_tet_points(n - 4);
}

/// @brief Place of a point: layers of constant k, in them rows of constant j.
[[nodiscard]] constexpr LocalIndex tet_index(LocalIndex n, const TetPoint& p) noexcept
{
  const LocalIndex rest = n - p.k;  // The layer is a triangle lattice with `rest` intervals.
  const LocalIndex before = num_tet_points(n) - num_tet_points(rest);
  return before + p.j * (rest + 1) - p.j * (p.j - 1) / 2 + p.i;
}

/// @brief Corners of the octahedron at the origin as sums of unit steps, for each choice of its
/// diagonal. The diagonal's ends come first, then the ring around it, such that (from, to, ring[m],
/// ring[m + 1]) is positive.
inline constexpr std::array<std::array<TetPoint, 6>, 3> kOctahedra{
    {{{{1, 0, 0}, {0, 1, 1}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}}},
     {{{0, 1, 0}, {1, 0, 1}, {1, 1, 0}, {0, 1, 1}, {0, 0, 1}, {1, 0, 0}}},
     {{{0, 0, 1}, {1, 1, 0}, {1, 0, 1}, {1, 0, 0}, {0, 1, 0}, {0, 1, 1}}}}};

/// @brief Calls visit(a, b, c, d) for each of the (n/step)^3 children, all positive if the coarse
/// tet is.
///
/// `diagonal` in {0, 1, 2} says how octahedra are cut. The diagonal goes from the middle of the
/// edge between corners 0 and diagonal + 1 to the middle of the opposite edge.
/// @pre step divides n.
template <class Visit>
constexpr void for_each_child(LocalIndex n, LocalIndex step, std::size_t diagonal, Visit&& visit)
{
  const TetPoint e1{1, 0, 0}, e2{0, 1, 0}, e3{0, 0, 1}, e12{1, 1, 0}, e13{1, 0, 1}, e23{0, 1, 1};
  const auto moved = [step](const TetPoint& p, const TetPoint& by) {
    return TetPoint{p.i + step * by.i, p.j + step * by.j, p.k + step * by.k};
  };
  for (LocalIndex k = 0; k < n; k += step) {
    for (LocalIndex j = 0; j + k < n; j += step) {
      for (LocalIndex i = 0; i + j + k < n; i += step) {
        const TetPoint p{i, j, k};
        visit(p, moved(p, e1), moved(p, e2), moved(p, e3));
        if (i + j + k + 2 * step > n) continue;
        const auto& octahedron = kOctahedra[diagonal];
        for (std::size_t m = 0; m < 4; ++m) {
          visit(moved(p, octahedron[0]), moved(p, octahedron[1]), moved(p, octahedron[2 + m]),
                moved(p, octahedron[2 + (m + 1) % 4]));
        }
        if (i + j + k + 3 * step > n) continue;
        visit(moved(p, e12), moved(p, e23), moved(p, e13), moved(p, {1, 1, 1}));
      }
    }
  }
}

/// @brief As for_each_child() with step 1, in the same order, but visit gets the tet_index() of the
/// corners. Each index is the first one of its row plus i, so a child costs a few additions.
template <class Visit>
constexpr void for_each_child_index(LocalIndex n, std::size_t diagonal, Visit&& visit)
{
  const auto& octahedron = kOctahedra[diagonal];
  for (LocalIndex k = 0; k < n; ++k) {
    for (LocalIndex j = 0; j + k < n; ++j) {
      // Corner (di, dj, dk) of the cell at i is first[dj][dk] + i + di.
      const std::array<std::array<LocalIndex, 2>, 2> first{
          {{tet_index(n, {0, j, k}), tet_index(n, {0, j, k + 1})},
           {tet_index(n, {0, j + 1, k}), tet_index(n, {0, j + 1, k + 1})}}};
      std::array<LocalIndex, 6> corners{};
      for (std::size_t c = 0; c < 6; ++c) {
        const TetPoint& by = octahedron[c];
        corners[c] = first[at(by.j)][at(by.k)] + by.i;
      }
      const LocalIndex length = n - j - k;
      for (LocalIndex i = 0; i < length; ++i) {
        visit(first[0][0] + i, first[0][0] + i + 1, first[1][0] + i, first[0][1] + i);
        if (i + 2 > length) continue;
        for (std::size_t m = 0; m < 4; ++m) {
          visit(corners[0] + i, corners[1] + i, corners[2 + m] + i, corners[2 + (m + 1) % 4] + i);
        }
        if (i + 3 > length) continue;
        visit(first[1][0] + i + 1, first[1][1] + i, first[0][1] + i + 1, first[1][1] + i + 1);
      }
    }
  }
}

}  // namespace tessera::mesh::lattice
