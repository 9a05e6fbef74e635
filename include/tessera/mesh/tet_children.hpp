// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <utility>

#include "tessera/mesh/cut_tet.hpp"
#include "tessera/mesh/tet_grading.hpp"
#include "tessera/mesh/tet_lattice.hpp"
#include "tessera/mesh/tet_topology.hpp"

namespace tessera::mesh {

/// @brief The corners of a child, as points of its coarse tet's lattice.
using ChildCorners = std::array<lattice::TetPoint, 4>;

namespace detail {

[[nodiscard]] constexpr std::array<LocalIndex, 4> weights(LocalIndex n, const lattice::TetPoint& p)
{
  return {n - p.i - p.j - p.k, p.i, p.j, p.k};
}

[[nodiscard]] constexpr lattice::TetPoint middle(const lattice::TetPoint& a,
                                                 const lattice::TetPoint& b)
{
  return {(a.i + b.i) / 2, (a.j + b.j) / 2, (a.k + b.k) / 2};
}

/// Bit c: the weight of corner c is not zero.
[[nodiscard]] constexpr unsigned support(const std::array<LocalIndex, 4>& weights)
{
  unsigned corners = 0;
  for (std::size_t c = 0; c < 4; ++c) corners |= weights[c] != 0 ? 1U << c : 0U;
  return corners;
}

/// Which edge of the coarse tet runs from a to b. @pre The two differ in two weights.
[[nodiscard]] constexpr std::size_t direction(LocalIndex n, const lattice::TetPoint& a,
                                              const lattice::TetPoint& b)
{
  const auto from = weights(n, a);
  const auto to = weights(n, b);
  std::size_t e = 0;
  while (from[kTetEdgeCorners[e][0]] == to[kTetEdgeCorners[e][0]]
         || from[kTetEdgeCorners[e][1]] == to[kTetEdgeCorners[e][1]]) {
    ++e;
  }
  return e;
}

}  // namespace detail

/// @brief Calls visit(a, b, c, d) with the points of each child, in the lattice of one level more:
/// 2 n intervals, so that there is room for the midpoints of cut children. All are positive if the
/// coarse tet is.
/// @param[in] diagonals From the ChildCorners of a child with five marks to its DiagonalLengths.
template <class Diagonals, class Visit>
void for_each_graded_child(const TetGrading& grading, Diagonals&& diagonals, Visit&& visit)
{
  using lattice::TetPoint;
  const LocalIndex n = 2 * grading.intervals();
  const auto cut = [&](const TetPoint& a, const TetPoint& b, const TetPoint& c, const TetPoint& d) {
    std::array<TetPoint, 10> nodes{a, b, c, d};
    TetEdgeOrder order{};
    unsigned marks = 0;
    for (std::size_t e = 0; e < kTetEdgeCorners.size(); ++e) {
      const auto [from, to] = kTetEdgeCorners[e];
      nodes[4 + e] = detail::middle(nodes[from], nodes[to]);
      if (!grading.is_finer_on(detail::support(detail::weights(n, nodes[4 + e])))) continue;
      marks |= 1U << e;
      order[e] = grading.order[detail::direction(n, nodes[from], nodes[to])];
    }
    if (marks == 0) {
      visit(a, b, c, d);
      return;
    }
    const bool has_choice = std::popcount(marks) == 5;
    const DiagonalLengths lengths =
        has_choice ? diagonals(ChildCorners{a, b, c, d}) : DiagonalLengths{};
    for (const auto& [p, q, r, s] : cut_tet(marks, order, lengths)) {
      visit(nodes[p], nodes[q], nodes[r], nodes[s]);
    }
  };
  lattice::for_each_child(n, 2, grading.diagonal, cut);
}

}  // namespace tessera::mesh
