// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include "tessera/base/types.hpp"
#include "tessera/base/vec3.hpp"
#include "tessera/mesh/complex.hpp"
#include "tessera/mesh/refined_lattice.hpp"
#include "tessera/mesh/tet_children.hpp"
#include "tessera/mesh/tet_face_map.hpp"
#include "tessera/mesh/tet_grading.hpp"
#include "tessera/mesh/tet_lattice.hpp"
#include "tessera/mesh/tet_topology.hpp"

namespace tessera::mesh {

/// @brief Grading of a tet of a complex. @param[in] lattice Refined lattice of complex.faces.
[[nodiscard]] TetGrading tet_grading(const TetComplex& complex, const RefinedLattice& lattice,
                                     LocalIndex tet);

/// @brief Intervals of the lattice in which all points of a tet have their *places*: its
/// lattice::tet_index().
[[nodiscard]] inline LocalIndex intervals_of_places(const TetGrading& grading)
{
  return grading.intervals() * (grading.is_uniform() ? 1 : 2);
}

/// @brief Calls on_edge(place, edge, k) for the points on the edges of a tet, ends included, and
/// on_triangle(place, triangle, p) for those inside its faces. k and p are of the own lattice of
/// the edge or triangle, a row of complex.faces.
template <class OnEdge, class OnTriangle>
void for_each_outer_point(const TetComplex& complex, const LatticeLevels& levels, LocalIndex tet,
                          const TetGrading& grading, OnEdge&& on_edge, OnTriangle&& on_triangle)
{
  const LocalIndex n = intervals_of_places(grading);
  const auto edges = edges_of_tet(complex, tet);
  const LocalIndex* v = &complex.tet_vertices[4 * at(tet)];
  for (std::size_t e = 0; e < edges.size(); ++e) {
    auto [from, to] = kTetEdgeCorners[e];
    if (v[to] < v[from]) std::swap(from, to);
    const LocalIndex own = levels.edge_intervals(edges[e]);
    const LocalIndex step = n / own;
    for (LocalIndex k = 0; k <= own; ++k) {
      std::array<LocalIndex, 4> weights{};
      weights[from] = n - step * k;
      weights[to] = step * k;
      on_edge(lattice::tet_index(n, {weights[1], weights[2], weights[3]}), edges[e], k);
    }
  }
  if (n < 3) return;  // No triangle has points inside.
  const TetFaceMap map(complex, tet);
  for (std::size_t c = 0; c < 4; ++c) {
    const LocalIndex triangle = map.triangle(c);
    const LocalIndex own = levels.triangle_intervals(triangle);
    const LocalIndex step = n / own;
    for (LocalIndex j = 1; j < own; ++j) {
      for (LocalIndex i = 1; i + j < own; ++i) {
        on_triangle(lattice::tet_index(n, map.tet_point(n, c, {step * i, step * j})), triangle,
                    lattice::TrianglePoint{i, j});
      }
    }
  }
}

/// @brief Calls visit(place, a, b) for the points inside a tet, level by level: each is the
/// midpoint of what stands at a and b, which is outside or of a level before.
///
/// A new point has two or four odd weights. With two it is the midpoint along the edge in which
/// they change. With four it is the middle of an octahedron: the midpoint of its diagonal.
template <class Visit>
void for_each_inner_point(const TetGrading& grading, Visit&& visit)
{
  const LocalIndex n = intervals_of_places(grading);
  const LocalIndex last_step = n / grading.intervals();
  const auto visit_point = [&](const lattice::TetPoint& p, LocalIndex step) {
    const std::array<bool, 3> odd{p.i / step % 2 != 0, p.j / step % 2 != 0, p.k / step % 2 != 0};
    const int num_odd = odd[0] + odd[1] + odd[2];
    if (num_odd == 0) return;
    std::array<LocalIndex, 3> by{};
    LocalIndex sign = 1;
    for (std::size_t d = 0; d < 3; ++d) {
      if (!odd[d]) continue;
      by[d] = sign * step;
      sign = -sign;
    }
    if (num_odd == 3) {
      by = {step, step, step};
      by[grading.diagonal] = -step;
    }
    visit(lattice::tet_index(n, p), lattice::tet_index(n, {p.i - by[0], p.j - by[1], p.k - by[2]}),
          lattice::tet_index(n, {p.i + by[0], p.j + by[1], p.k + by[2]}));
  };
  for (LocalIndex step = n / 2; step >= last_step; step /= 2) {
    for (LocalIndex k = step; k < n; k += step) {
      for (LocalIndex j = step; j + k < n; j += step) {
        for (LocalIndex i = step; i + j + k < n; i += step) visit_point({i, j, k}, step);
      }
    }
  }
}

/// @brief Calls visit(a, b, c, d) with the places of the corners of each child.
/// @param[in] point_at Gives the position at a place.
template <class PointAt, class Visit>
void for_each_child(const TetGrading& grading, PointAt&& point_at, Visit&& visit)
{
  const LocalIndex n = intervals_of_places(grading);
  if (grading.is_uniform()) {
    lattice::for_each_child_index(n, grading.diagonal, visit);
    return;
  }
  const auto place = [n](const lattice::TetPoint& p) { return lattice::tet_index(n, p); };
  const auto diagonals_of = [&](const ChildCorners& child) {
    DiagonalLengths lengths{};
    for (std::size_t e = 0; e < lengths.size(); ++e) {
      const auto middle = [&](std::size_t edge) {
        const auto [a, b] = kTetEdgeCorners[edge];
        return midpoint(point_at(place(child[a])), point_at(place(child[b])));
      };
      const Vec3 diagonal = middle(e) - middle(kTetEdgeCorners.size() - 1 - e);
      lengths[e] = dot(diagonal, diagonal);
    }
    return lengths;
  };
  for_each_graded_child(
      grading, diagonals_of,
      [&](const lattice::TetPoint& a, const lattice::TetPoint& b, const lattice::TetPoint& c,
          const lattice::TetPoint& d) { visit(place(a), place(b), place(c), place(d)); });
}

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
    mesh::for_each_child(
        grading_, [&](LocalIndex place) { return points_[static_cast<std::size_t>(place)]; },
        visit);
  }

 private:
  TetGrading grading_;
  LocalIndex n_;
  std::vector<Vec3> points_;
};

}  // namespace tessera::mesh
