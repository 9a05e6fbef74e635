// SPDX-License-Identifier: BSD-3-Clause
#include "refine/image_points.hpp"

namespace tessera::refine {
namespace {

namespace lattice = mesh::lattice;

class Mover {
 public:
  Mover(const mesh::Complex& complex, const mesh::Orbits& orbits, mesh::RefinedLattice& points)
      : complex_(complex), orbits_(orbits), points_(points)
  {
  }

  void move_edge(LocalIndex e, LocalIndex image, const std::function<Vec3(LocalIndex)>& position)
  {
    const LocalIndex n = points_.edge_intervals(e);
    for (LocalIndex k = 1; k < n; ++k) {
      points_.place_edge_point(e, k, orbits_.image(image, points_.edge_point(e, k)));
    }
    for (LocalIndex end = 0; end < 2; ++end) {
      const LocalIndex vertex = complex_.edge_vertices[2 * at(e) + at(end)];
      points_.place_edge_point(e, end * n, position(complex_.vertex_coarse[at(vertex)]));
    }
  }

  /// @pre All edges are where they belong.
  void move_triangle(LocalIndex t)
  {
    const LocalIndex image = orbits_.triangles.image_of(complex_.triangle_skeleton[at(t)]);
    const LocalIndex n = points_.triangle_intervals(t);
    for (LocalIndex j = 1; j < n; ++j) {
      for (LocalIndex i = 1; i + j < n; ++i) {
        const lattice::TrianglePoint p{i, j};
        points_.place_triangle_point(t, p, orbits_.image(image, points_.triangle_point(t, p)));
      }
    }
    for (std::size_t side = 0; side < 3; ++side) {
      for (LocalIndex k = 0; k <= n; ++k) {
        points_.place_triangle_point(t, lattice::side_point(n, side, k),
                                     point_of_side(complex_, points_, t, side, k));
      }
    }
  }

 private:
  const mesh::Complex& complex_;
  const mesh::Orbits& orbits_;
  mesh::RefinedLattice& points_;
};

}  // namespace

Vec3 point_of_side(const mesh::Complex& complex, const mesh::RefinedLattice& points, LocalIndex t,
                   std::size_t side, LocalIndex k)
{
  const LocalIndex e = complex.triangle_edges[3 * at(t) + side];
  return points.edge_point(e, k << (points.levels().edge(e) - points.levels().triangle(t)));
}

void move_to_images(const mesh::Complex& complex, const mesh::Orbits& orbits,
                    const std::function<const mesh::OrbitTable&(LocalIndex)>& orbits_of_edge,
                    const std::function<Vec3(LocalIndex)>& position, mesh::RefinedLattice& points)
{
  if (orbits.are_none()) return;
  Mover mover(complex, orbits, points);
  for (LocalIndex e = 0; e < complex.num_edges(); ++e) {
    const LocalIndex edge = complex.edge_skeleton[at(e)];
    if (edge == kNoIndex) continue;
    const mesh::OrbitTable& table = orbits_of_edge(edge);
    if (table.origin_of(edge) != edge) mover.move_edge(e, table.image_of(edge), position);
  }
  for (LocalIndex t = 0; t < complex.num_triangles(); ++t) {
    const LocalIndex triangle = complex.triangle_skeleton[at(t)];
    const bool is_moved = triangle != kNoIndex && orbits.triangles.origin_of(triangle) != triangle;
    if (is_moved) mover.move_triangle(t);
  }
}

}  // namespace tessera::refine
