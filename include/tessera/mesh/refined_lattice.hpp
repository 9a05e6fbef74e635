// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "tessera/base/types.hpp"
#include "tessera/base/vec3.hpp"
#include "tessera/mesh/lattice.hpp"

namespace tessera::mesh {

/// @brief How far the points on the geometry are from it, each measured by a second projection.
struct ModelDistance {
  double largest = 0.0;            ///< Over the points that were not held back; output length unit.
  double largest_held_back = 0.0;  ///< Over the points that the plan left off the geometry.
  LocalIndex num_held_back = 0;    ///< Their number.
};

/// @brief Positions of all lattice points of a complex.
struct RefinedLattice {
  LocalIndex n = 1;                    ///< Intervals of an edge.
  std::vector<double> edge_xyz{};      ///< Shape (num_edges, n + 1, 3).
  std::vector<double> triangle_xyz{};  ///< Shape (num_triangles, num_triangle_points(n), 3).
  ModelDistance distance{};            ///< Measured if the context asks for it.

  [[nodiscard]] Vec3 edge_point(LocalIndex edge, LocalIndex k) const
  {
    return point_at(std::span(edge_xyz),
                    static_cast<std::size_t>(edge) * row_of_edge() + offset(k));
  }

  [[nodiscard]] Vec3 triangle_point(LocalIndex triangle, const lattice::TrianglePoint& p) const
  {
    return point_at(std::span(triangle_xyz), static_cast<std::size_t>(triangle) * row_of_triangle()
                                                 + offset(lattice::triangle_index(n, p.i, p.j)));
  }

 private:
  static std::size_t offset(LocalIndex i) { return static_cast<std::size_t>(i); }
  [[nodiscard]] std::size_t row_of_edge() const { return offset(n) + 1; }
  [[nodiscard]] std::size_t row_of_triangle() const
  {
    return offset(lattice::num_triangle_points(n));
  }
};

}  // namespace tessera::mesh
