// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "tessera/base/types.hpp"
#include "tessera/base/vec3.hpp"
#include "tessera/mesh/lattice.hpp"
#include "tessera/mesh/lattice_levels.hpp"

namespace tessera::mesh {

/// @brief How far the points on the geometry are from it, each measured by a second projection.
struct ModelDistance {
  double largest = 0.0;            ///< Over the points that were not held back; output length unit.
  double largest_held_back = 0.0;  ///< Over the points that the plan left off the geometry.
  LocalIndex num_held_back = 0;    ///< Their number.
};

/// @brief Positions of all lattice points of a complex, each edge and triangle with its own level.
class RefinedLattice {
 public:
  RefinedLattice() = default;

  /// @brief All points at the origin, for the caller to place.
  explicit RefinedLattice(LatticeLevels levels);

  [[nodiscard]] const LatticeLevels& levels() const { return levels_; }

  /// @brief Intervals of an edge, and of the sides of a triangle's lattice.
  [[nodiscard]] LocalIndex edge_intervals(LocalIndex e) const { return levels_.edge_intervals(e); }
  [[nodiscard]] LocalIndex triangle_intervals(LocalIndex t) const
  {
    return levels_.triangle_intervals(t);
  }

  /// @brief The most that any edge has.
  [[nodiscard]] LocalIndex most_intervals() const { return lattice::intervals(levels_.largest()); }

  [[nodiscard]] Vec3 edge_point(LocalIndex e, LocalIndex k) const
  {
    return edge_points_[edge_place(e, k)];
  }
  [[nodiscard]] Vec3 triangle_point(LocalIndex t, const lattice::TrianglePoint& p) const
  {
    return triangle_points_[triangle_place(t, p)];
  }
  void place_edge_point(LocalIndex e, LocalIndex k, const Vec3& point)
  {
    edge_points_[edge_place(e, k)] = point;
  }
  void place_triangle_point(LocalIndex t, const lattice::TrianglePoint& p, const Vec3& point)
  {
    triangle_points_[triangle_place(t, p)] = point;
  }

  /// @brief Appends the triangles of another lattice. Its edges stay behind.
  void append_triangles(const RefinedLattice& other);

  /// @brief All points of edges, and of triangles, one entity after the other.
  [[nodiscard]] std::span<const Vec3> edge_points() const { return edge_points_; }
  [[nodiscard]] std::span<const Vec3> triangle_points() const { return triangle_points_; }

  /// @brief Place of a point in edge_points(), or in triangle_points().
  [[nodiscard]] std::size_t edge_place(LocalIndex e, LocalIndex k) const
  {
    return first_of_edge_[at(e)] + at(k);
  }
  [[nodiscard]] std::size_t triangle_place(LocalIndex t, const lattice::TrianglePoint& p) const
  {
    return first_of_triangle_[at(t)] + at(lattice::triangle_index(triangle_intervals(t), p.i, p.j));
  }

  ModelDistance distance{};  ///< Measured if the context asks for it.

  /// Where the columns of these points end, of the same shape; null if the mesh has no layers. What
  /// has no column ends where it begins.
  std::shared_ptr<const RefinedLattice> walls{};

 private:
  LatticeLevels levels_{};
  std::vector<std::size_t> first_of_edge_{};      ///< Shape (num_edges).
  std::vector<std::size_t> first_of_triangle_{};  ///< Shape (num_triangles).
  std::vector<Vec3> edge_points_{};
  std::vector<Vec3> triangle_points_{};
};

}  // namespace tessera::mesh
