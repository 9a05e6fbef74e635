// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "tessera/base/types.hpp"
#include "tessera/mesh/coarse_mesh.hpp"
#include "tessera/mesh/complex.hpp"
#include "tessera/mesh/cut_tet.hpp"
#include "tessera/mesh/lattice.hpp"
#include "tessera/mesh/lattice_levels.hpp"
#include "tessera/mesh/refined_lattice.hpp"
#include "tessera/mesh/skeleton.hpp"
#include "tessera/mesh/tet_grading.hpp"

namespace tessera::mesh {

/// @brief Corners of the sides of a triangle, in the order of lattice::side_point().
inline constexpr std::array<std::array<std::size_t, 2>, 3> kSideEnds{{{0, 1}, {0, 2}, {1, 2}}};

/// @brief What the small triangles of one coarse triangle are a function of, besides its points.
struct TriangleGrading {
  int level = 0;       ///< Of its lattice: the smallest of its sides.
  unsigned finer = 0;  ///< Bit s: side s (01, 02, 12) has one level more.
  SideOrder order{};   ///< Of its sides, by edge_rank().

  [[nodiscard]] bool is_uniform() const { return finer == 0; }

  /// @brief Intervals of the lattice in which all its points have places: that of its finest side.
  [[nodiscard]] LocalIndex finest_intervals() const
  {
    return lattice::intervals(level + (is_uniform() ? 0 : 1));
  }

  /// @param[in] ranks, levels Of the sides. The levels differ by one at most.
  [[nodiscard]] static TriangleGrading of(const std::array<EdgeRank, 3>& ranks,
                                          const std::array<int, 3>& levels);
};

/// @brief Grading of triangle `t` of a complex, or of the skeleton of a coarse mesh. Local.
[[nodiscard]] TriangleGrading triangle_grading(const Complex& complex,
                                               const RefinedLattice& lattice, LocalIndex t);
[[nodiscard]] TriangleGrading triangle_grading(const Skeleton& skeleton, const CoarseMesh& coarse,
                                               const LatticeLevels& levels, LocalIndex t);

/// @brief Calls visit(a, b, c) for each small triangle, as lattice::for_each_small_triangle() does,
/// and cuts those on finer sides. Points are in the lattice with finest_intervals().
template <class Visit>
void for_each_graded_triangle(const TriangleGrading& grading, Visit&& visit)
{
  using lattice::TrianglePoint;
  const LocalIndex n = grading.finest_intervals();
  if (grading.is_uniform()) {
    lattice::for_each_small_triangle(n, 1, visit);
    return;
  }
  const auto is_on = [n](const TrianglePoint& p, std::size_t side) {
    return side == 0 ? p.j == 0 : side == 1 ? p.i == 0 : p.i + p.j == n;
  };
  // Sides of a small triangle on a side of the coarse one are in the same order as these.
  const auto cut = [&](const TrianglePoint& a, const TrianglePoint& b, const TrianglePoint& c) {
    std::array<TrianglePoint, 6> nodes{a, b, c};
    unsigned marks = 0;
    for (std::size_t side = 0; side < 3; ++side) {
      const TrianglePoint& p = nodes[kSideEnds[side][0]];
      const TrianglePoint& q = nodes[kSideEnds[side][1]];
      nodes[3 + side] = {(p.i + q.i) / 2, (p.j + q.j) / 2};
      const bool is_finer = (grading.finer >> side & 1U) != 0;
      if (is_finer && is_on(p, side) && is_on(q, side)) marks |= 1U << side;
    }
    for (const auto& [p, q, r] : cut_triangle(marks, grading.order)) {
      visit(nodes[p], nodes[q], nodes[r]);
    }
  };
  lattice::for_each_small_triangle(n, 2, cut);
}

/// @brief The same once each of these triangles was split into `parts`^2 equal ones. Points are in
/// the lattice with `parts` times finest_intervals().
template <class Visit>
void for_each_split_triangle(const TriangleGrading& grading, LocalIndex parts, Visit&& visit)
{
  using lattice::TrianglePoint;
  for_each_graded_triangle(
      grading, [&](const TrianglePoint& a, const TrianglePoint& b, const TrianglePoint& c) {
        const lattice::SmallTriangle small{a, b, c};
        lattice::for_each_small_triangle(
            parts, 1, [&](const TrianglePoint& p, const TrianglePoint& q, const TrianglePoint& r) {
              visit(small.point(parts, p), small.point(parts, q), small.point(parts, r));
            });
      });
}

/// @brief Points inside of the coarse triangle after such a split: a closed form.
[[nodiscard]] LocalIndex num_inner_split_points(const TriangleGrading& grading, LocalIndex parts);

/// @brief Dense numbers of these points, in the order of their places in the lattice.
class SplitPointNumbers {
 public:
  SplitPointNumbers(const TriangleGrading& grading, LocalIndex parts);

  /// @pre The point lies inside of the coarse triangle, and the split has it.
  [[nodiscard]] LocalIndex of(const lattice::TrianglePoint& p) const
  {
    return number_[at(lattice::inner_triangle_index(n_, p.i, p.j))];
  }

 private:
  LocalIndex n_;                    ///< Intervals of the lattice.
  std::vector<LocalIndex> number_;  ///< Shape (num_inner_triangle_points(n)); kNoIndex: none.
};

}  // namespace tessera::mesh
