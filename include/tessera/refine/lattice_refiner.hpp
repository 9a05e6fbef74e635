// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "tessera/base/types.hpp"
#include "tessera/base/vec3.hpp"
#include "tessera/mesh/coarse_mesh.hpp"
#include "tessera/mesh/complex.hpp"
#include "tessera/mesh/damping.hpp"
#include "tessera/mesh/lattice.hpp"
#include "tessera/mesh/skeleton.hpp"
#include "tessera/model/model.hpp"

namespace tessera::refine {

/// @brief Everything a lattice point's position is a pure function of. Borrowed, not owned.
struct RefineContext {
  const mesh::CoarseMesh& coarse;
  const mesh::Skeleton& skeleton;
  const model::Model& model;
  const mesh::Damping& damping;
  int levels = 0;
  bool measure_distance = false;  ///< Fill RefinedLattice::distance; twice the projections.
};

/// @brief How far the points on the geometry are from it, each measured by a second projection.
struct ModelDistance {
  double largest = 0.0;         ///< Over the points that were not damped; output length unit.
  double largest_damped = 0.0;  ///< Over the points that the plan left off the geometry.
  LocalIndex num_damped = 0;    ///< Their number.
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

  [[nodiscard]] Vec3 triangle_point(LocalIndex triangle,
                                    const mesh::lattice::TrianglePoint& p) const
  {
    return point_at(std::span(triangle_xyz),
                    static_cast<std::size_t>(triangle) * row_of_triangle()
                        + offset(mesh::lattice::triangle_index(n, p.i, p.j)));
  }

 private:
  static std::size_t offset(LocalIndex i) { return static_cast<std::size_t>(i); }
  [[nodiscard]] std::size_t row_of_edge() const { return offset(n) + 1; }
  [[nodiscard]] std::size_t row_of_triangle() const
  {
    return offset(mesh::lattice::num_triangle_points(n));
  }
};

/// @brief Refines the edges and triangles of a complex, level by level; new points on the geometry
/// are projected at every level, curves first (DESIGN: one projection at the end would fold).
///
/// A point's position depends on its coarse entity and the context only, so every subdomain that
/// shares it computes the same bits without a message.
///
/// @note Local.
/// @throws GeometryError if a projection fails.
[[nodiscard]] RefinedLattice refine_lattice(const mesh::Complex& complex,
                                            const RefineContext& context);

}  // namespace tessera::refine
