// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/mesh/tet_points.hpp"

#include <algorithm>
#include <array>

#include "tessera/mesh/tet_face_map.hpp"

namespace tessera::mesh {

using lattice::TetPoint;
using lattice::TrianglePoint;

TetFaceMap::TetFaceMap(const TetComplex& complex, LocalIndex tet)
{
  const auto row = 4 * static_cast<std::size_t>(tet);
  const LocalIndex* vertices = &complex.tet_vertices[row];
  for (std::size_t c = 0; c < 4; ++c) {
    triangles_[c] = complex.tet_triangles[row + c];
    corners_[c] = kTetFaceCorners[c];
    std::sort(corners_[c].begin(), corners_[c].end(),
              [vertices](std::size_t a, std::size_t b) { return vertices[a] < vertices[b]; });
  }
}

TetPoint TetFaceMap::tet_point(LocalIndex n, std::size_t c, const TrianglePoint& p) const
{
  std::array<LocalIndex, 4> weights{};
  weights[corners_[c][0]] = n - p.i - p.j;
  weights[corners_[c][1]] = p.i;
  weights[corners_[c][2]] = p.j;
  return {weights[1], weights[2], weights[3]};
}

TrianglePoint TetFaceMap::triangle_point(LocalIndex n, std::size_t c, const TetPoint& p) const
{
  const std::array<LocalIndex, 4> weights{n - p.i - p.j - p.k, p.i, p.j, p.k};
  return {weights[corners_[c][1]], weights[corners_[c][2]]};
}

TetGrading tet_grading(const TetComplex& complex, const RefinedLattice& lattice, LocalIndex tet)
{
  const auto edges = edges_of_tet(complex, tet);
  const LocalIndex* v = &complex.tet_vertices[4 * static_cast<std::size_t>(tet)];
  std::array<int, 6> levels{};
  std::array<Vec3, 4> corners{};
  std::array<Vec3, 4> ranked{};
  for (std::size_t e = 0; e < edges.size(); ++e) {
    levels[e] = lattice.levels().edge(edges[e]);
    auto [from, to] = kTetEdgeCorners[e];
    if (v[to] < v[from]) std::swap(from, to);
    corners[from] = lattice.edge_point(edges[e], 0);
    corners[to] = lattice.edge_point(edges[e], lattice.edge_intervals(edges[e]));
    const auto [first, last] = rank_positions(lattice, edges[e]);
    ranked[from] = first;
    ranked[to] = last;
  }
  return TetGrading::of(corners, ranked, {v[0], v[1], v[2], v[3]}, levels);
}

TetPoints::TetPoints(const TetComplex& complex, const RefinedLattice& lattice, LocalIndex tet)
    : grading_(tet_grading(complex, lattice, tet)),
      n_(intervals_of_places(grading_)),
      points_(static_cast<std::size_t>(lattice::num_tet_points(n_)))
{
  const auto place_at = [&](LocalIndex place) -> Vec3& {
    return points_[static_cast<std::size_t>(place)];
  };
  for_each_outer_point(
      complex, lattice.levels(), tet, grading_,
      [&](LocalIndex place, LocalIndex edge, LocalIndex k) {
        place_at(place) = lattice.edge_point(edge, k);
      },
      [&](LocalIndex place, LocalIndex triangle, const TrianglePoint& p) {
        place_at(place) = lattice.triangle_point(triangle, p);
      });
  for_each_inner_point(grading_, [&](LocalIndex place, LocalIndex a, LocalIndex b) {
    place_at(place) = midpoint(place_at(a), place_at(b));
  });
}

}  // namespace tessera::mesh
