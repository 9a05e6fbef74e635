// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/mesh/tet_points.hpp"

#include <algorithm>
#include <array>

#include "tessera/mesh/tet_face_map.hpp"
#include "tessera/mesh/tet_topology.hpp"

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

TetPoints::TetPoints(const TetComplex& complex, const RefinedLattice& lattice, LocalIndex tet)
    : n_(lattice.n), points_(static_cast<std::size_t>(lattice::num_tet_points(lattice.n)))
{
  copy_faces(complex, lattice, tet);
  choose_diagonal();
  fill_inside();
}

void TetPoints::copy_faces(const TetComplex& complex, const RefinedLattice& lattice, LocalIndex tet)
{
  const TetFaceMap map(complex, tet);
  for (std::size_t c = 0; c < 4; ++c) {
    for (LocalIndex j = 0; j <= n_; ++j) {
      for (LocalIndex i = 0; i + j <= n_; ++i) {
        const auto place = lattice::tet_index(n_, map.tet_point(n_, c, {i, j}));
        points_[static_cast<std::size_t>(place)] = lattice.triangle_point(map.triangle(c), {i, j});
      }
    }
  }
}

void TetPoints::choose_diagonal()
{
  const std::array<Vec3, 4> corners{at({0, 0, 0}), at({n_, 0, 0}), at({0, n_, 0}), at({0, 0, n_})};
  double shortest = 0.0;
  for (std::size_t d = 0; d < 3; ++d) {
    const Vec3 diagonal = midpoint(corners[0], corners[d + 1])
                          - midpoint(corners[1 + (d + 1) % 3], corners[1 + (d + 2) % 3]);
    const double length = dot(diagonal, diagonal);
    if (d == 0 || length < shortest) {
      shortest = length;
      diagonal_ = d;
    }
  }
}

// A new inner point has two or four odd weights. With two it is the midpoint along the edge in
// which they change. With four it is the middle of an octahedron: the midpoint of its diagonal.
void TetPoints::fill_inside()
{
  for (LocalIndex step = n_ / 2; step >= 1; step /= 2) {
    for (LocalIndex k = step; k < n_; k += step) {
      for (LocalIndex j = step; j + k < n_; j += step) {
        for (LocalIndex i = step; i + j + k < n_; i += step) {
          const std::array<bool, 3> odd{(i / step) % 2 != 0, (j / step) % 2 != 0,
                                        (k / step) % 2 != 0};
          const int num_odd = odd[0] + odd[1] + odd[2];
          if (num_odd == 0) continue;
          std::array<LocalIndex, 3> by{};
          if (num_odd == 3) {
            by = {step, step, step};
            by[diagonal_] = -step;
          } else {
            LocalIndex sign = 1;
            for (std::size_t d = 0; d < 3; ++d) {
              if (!odd[d]) continue;
              by[d] = sign * step;
              sign = -sign;
            }
          }
          points_[static_cast<std::size_t>(lattice::tet_index(n_, {i, j, k}))] = midpoint(
              at({i - by[0], j - by[1], k - by[2]}), at({i + by[0], j + by[1], k + by[2]}));
        }
      }
    }
  }
}

}  // namespace tessera::mesh
