// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tessera/mesh/complex.hpp"
#include "tessera/mesh/skin.hpp"
#include "tessera/refine/lattice_refiner.hpp"

namespace tessera::refine {

/// @brief Local numbers of the lattice points of a complex: its vertices, then the inner points of
/// its edges, then those of its triangles.
class LatticeNumbering {
 public:
  LatticeNumbering(const mesh::Complex& complex, LocalIndex n);

  [[nodiscard]] LocalIndex num_points() const { return num_points_; }

  /// @brief Number of point `k` of edge `e`, the ends included.
  [[nodiscard]] LocalIndex edge_point(LocalIndex e, LocalIndex k) const;

  /// @brief Number of point `p` of triangle `t`, sides and corners included.
  [[nodiscard]] LocalIndex triangle_point(LocalIndex t,
                                          const mesh::lattice::TrianglePoint& p) const;

 private:
  const mesh::Complex& complex_;
  LocalIndex n_;
  LocalIndex first_edge_point_;
  LocalIndex first_triangle_point_;
  LocalIndex num_points_;
};

/// @brief The skin of a subdomain from the refined lattice of its skin_complex().
/// @note Local.
[[nodiscard]] mesh::Skin extract_skin(const mesh::Complex& complex,
                                      const mesh::RefinedLattice& lattice,
                                      const mesh::Skeleton& skeleton, LocalIndex subdomain);

}  // namespace tessera::refine
