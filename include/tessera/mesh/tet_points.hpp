// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "tessera/base/types.hpp"
#include "tessera/base/vec3.hpp"
#include "tessera/mesh/complex.hpp"
#include "tessera/mesh/refined_lattice.hpp"
#include "tessera/mesh/tet_children.hpp"
#include "tessera/mesh/tet_face_map.hpp"
#include "tessera/mesh/tet_grading.hpp"
#include "tessera/mesh/tet_lattice.hpp"

namespace tessera::mesh {

/// @brief Grading of a tet of a complex. @param[in] lattice Refined lattice of complex.faces.
[[nodiscard]] TetGrading tet_grading(const TetComplex& complex, const RefinedLattice& lattice,
                                     LocalIndex tet);

/// @brief All lattice points of one coarse tet. Those on its faces are the refined lattice's. Those
/// inside are midpoints of older points, level by level, so that what projection moved on the
/// surface reaches the inside.
///
/// If edges of the tet have a level more than it has itself, points have their places in the
/// lattice of that level. What it has beside them is at the origin and belongs to nothing.
class TetPoints {
 public:
  /// @param[in] tet Row of complex.tets. The references are not kept.
  TetPoints(const TetComplex& complex, const RefinedLattice& lattice, LocalIndex tet);

  [[nodiscard]] const TetGrading& grading() const { return grading_; }

  /// @brief Intervals of the lattice in which the points have their places.
  [[nodiscard]] LocalIndex intervals() const { return n_; }

  [[nodiscard]] const Vec3& at(const lattice::TetPoint& p) const
  {
    return points_[static_cast<std::size_t>(lattice::tet_index(n_, p))];
  }

  /// @brief All points, in the order of lattice::tet_index().
  [[nodiscard]] const std::vector<Vec3>& all() const { return points_; }

  /// @brief Calls visit(a, b, c, d) with the lattice::tet_index() of the corners of each child.
  template <class Visit>
  void for_each_child(Visit&& visit) const
  {
    if (grading_.is_uniform()) {
      lattice::for_each_child_index(n_, grading_.diagonal, visit);
      return;
    }
    const auto place = [&](const lattice::TetPoint& p) { return lattice::tet_index(n_, p); };
    for_each_graded_child(
        grading_, [&](const ChildCorners& child) { return diagonals_of(child); },
        [&](const lattice::TetPoint& a, const lattice::TetPoint& b, const lattice::TetPoint& c,
            const lattice::TetPoint& d) { visit(place(a), place(b), place(c), place(d)); });
  }

 private:
  [[nodiscard]] DiagonalLengths diagonals_of(const ChildCorners& child) const;
  void fill_inside();

  TetGrading grading_;
  LocalIndex n_;
  std::vector<Vec3> points_;
};

/// @brief Calls visit(place, triangle, p) for the points that a tet's faces have in their own
/// lattices, sides and corners included: p on triangle, a row of complex.faces, has the
/// lattice::tet_index() `place` in the lattice of TetPoints. Then on_edge(place, edge, k) for the
/// points of edges that are finer than the tet.
template <class OnFace, class OnEdge>
void for_each_outer_point(const TetComplex& complex, const LatticeLevels& levels, LocalIndex tet,
                          const TetGrading& grading, OnFace&& on_face, OnEdge&& on_edge)
{
  const int finest = grading.level + (grading.is_uniform() ? 0 : 1);
  const LocalIndex n = lattice::intervals(finest);
  const TetFaceMap map(complex, tet);
  for (std::size_t c = 0; c < 4; ++c) {
    const LocalIndex triangle = map.triangle(c);
    const LocalIndex own = levels.triangle_intervals(triangle);
    const LocalIndex step = lattice::intervals(finest - levels.triangle(triangle));
    for (LocalIndex j = 0; j <= own; ++j) {
      for (LocalIndex i = 0; i + j <= own; ++i) {
        on_face(lattice::tet_index(n, map.tet_point(n, c, {step * i, step * j})), triangle,
                lattice::TrianglePoint{i, j});
      }
    }
  }
  if (grading.is_uniform()) return;
  const auto edges = edges_of_tet(complex, tet);
  for (std::size_t e = 0; e < edges.size(); ++e) {
    if ((grading.finer >> e & 1U) == 0) continue;
    auto [from, to] = kTetEdgeCorners[e];
    const LocalIndex* v = &complex.tet_vertices[4 * static_cast<std::size_t>(tet)];
    if (v[to] < v[from]) std::swap(from, to);
    for (LocalIndex k = 0; k <= n; ++k) {
      std::array<LocalIndex, 4> weights{};
      weights[from] = n - k;
      weights[to] = k;
      on_edge(lattice::tet_index(n, {weights[1], weights[2], weights[3]}), edges[e], k);
    }
  }
}

}  // namespace tessera::mesh
