// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "tessera/base/types.hpp"
#include "tessera/base/vec3.hpp"
#include "tessera/mesh/complex.hpp"
#include "tessera/mesh/refined_lattice.hpp"
#include "tessera/mesh/tet_lattice.hpp"

namespace tessera::mesh {

/// @brief All lattice points of one coarse tet. Those on its faces are the refined lattice's. Those
/// inside are midpoints of older points, level by level, so that what projection moved on the
/// surface reaches the inside.
class TetPoints {
 public:
  /// @param[in] tet Row of complex.tets. The references are not kept.
  TetPoints(const TetComplex& complex, const RefinedLattice& lattice, LocalIndex tet);

  [[nodiscard]] const Vec3& at(const lattice::TetPoint& p) const
  {
    return points_[static_cast<std::size_t>(lattice::tet_index(n_, p))];
  }

  /// @brief All points, in the order of lattice::tet_index().
  [[nodiscard]] const std::vector<Vec3>& all() const { return points_; }

  /// @brief The shortest of the coarse tet's three diagonals, as for_each_child() wants it; the
  /// lowest of equal ones.
  [[nodiscard]] std::size_t diagonal() const { return diagonal_; }

 private:
  void copy_faces(const TetComplex& complex, const RefinedLattice& lattice, LocalIndex tet);
  void choose_diagonal();
  void fill_inside();

  LocalIndex n_;
  std::size_t diagonal_ = 0;
  std::vector<Vec3> points_;
};

}  // namespace tessera::mesh
