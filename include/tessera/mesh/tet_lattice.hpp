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

/// @brief Place of a point: layers of constant k, in them rows of constant j.
[[nodiscard]] constexpr LocalIndex tet_index(LocalIndex n, const TetPoint& p) noexcept
{
  const LocalIndex rest = n - p.k;  // The layer is a triangle lattice with `rest` intervals.
  const LocalIndex before = num_tet_points(n) - num_tet_points(rest);
  return before + p.j * (rest + 1) - p.j * (p.j - 1) / 2 + p.i;
}

/// @brief Calls visit(a, b, c, d) for each of the (n/step)^3 children, all positive if the coarse
/// tet is. `diagonal` in {0, 1, 2}: the octahedra are cut along the diagonal from the middle of the
/// edge between corners 0 and diagonal + 1 to the middle of the opposite edge.
/// @pre step divides n.
template <class Visit>
constexpr void for_each_child(LocalIndex n, LocalIndex step, std::size_t diagonal, Visit&& visit)
{
  // The octahedron's corners as sums of steps (e1, e2, e3): its diagonal first, then the ring
  // around it, such that (from, to, ring[m], ring[m + 1]) is positive.
  constexpr TetPoint e1{1, 0, 0}, e2{0, 1, 0}, e3{0, 0, 1}, e12{1, 1, 0}, e13{1, 0, 1},
      e23{0, 1, 1};
  constexpr std::array<std::array<TetPoint, 6>, 3> octahedra{
      {{e1, e23, e12, e2, e3, e13}, {e2, e13, e12, e23, e3, e1}, {e3, e12, e13, e1, e2, e23}}};
  const auto moved = [step](const TetPoint& p, const TetPoint& by) {
    return TetPoint{p.i + step * by.i, p.j + step * by.j, p.k + step * by.k};
  };
  for (LocalIndex k = 0; k < n; k += step) {
    for (LocalIndex j = 0; j + k < n; j += step) {
      for (LocalIndex i = 0; i + j + k < n; i += step) {
        const TetPoint p{i, j, k};
        visit(p, moved(p, e1), moved(p, e2), moved(p, e3));
        if (i + j + k + 2 * step > n) continue;
        const auto& octahedron = octahedra[diagonal];
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

}  // namespace tessera::mesh::lattice
