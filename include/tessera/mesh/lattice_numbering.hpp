// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "tessera/base/types.hpp"
#include "tessera/mesh/complex.hpp"
#include "tessera/mesh/lattice.hpp"
#include "tessera/mesh/lattice_levels.hpp"

namespace tessera::mesh {

/// @brief Local numbers of the lattice points of a complex.
///
/// First those on the skeleton: vertices, inner points of edges, inner points of triangles; then in
/// the same order those off it. So the points of a subdomain's skin have the numbers they have in
/// skin_complex(), whether its complex holds the skin alone or its tets as well. They are the
/// numbers of the vertices of a Skin, and of a subdivided Piece. Complex and levels are borrowed.
class LatticeNumbering {
 public:
  LatticeNumbering(const Complex& complex, const LatticeLevels& levels);

  [[nodiscard]] LocalIndex num_points() const { return num_points_; }
  [[nodiscard]] LocalIndex num_skeleton_points() const { return num_skeleton_points_; }

  [[nodiscard]] LocalIndex vertex(LocalIndex v) const { return vertex_[at(v)]; }

  /// @brief Number of point `k` of edge `e`, the ends included, in the edge's own lattice.
  [[nodiscard]] LocalIndex edge_point(LocalIndex e, LocalIndex k) const;

  /// @brief Number of point `p` of triangle `t`, sides and corners included.
  /// @param[in] n Intervals of the lattice of `p`: the triangle's own, or those of a finer side.
  [[nodiscard]] LocalIndex triangle_point(LocalIndex t, LocalIndex n,
                                          const lattice::TrianglePoint& p) const;

 private:
  void number(bool on_skeleton);
  [[nodiscard]] LocalIndex side_point(LocalIndex e, LocalIndex n, LocalIndex k) const;

  const Complex& complex_;
  const LatticeLevels& levels_;
  std::vector<LocalIndex> vertex_{};             ///< Shape (num_vertices).
  std::vector<LocalIndex> first_of_edge_{};      ///< Shape (num_edges); of its inner points.
  std::vector<LocalIndex> first_of_triangle_{};  ///< Shape (num_triangles); of its inner points.
  LocalIndex num_points_ = 0;
  LocalIndex num_skeleton_points_ = 0;
};

}  // namespace tessera::mesh
