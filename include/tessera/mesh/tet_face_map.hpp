// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>

#include "tessera/base/types.hpp"
#include "tessera/mesh/complex.hpp"
#include "tessera/mesh/lattice.hpp"
#include "tessera/mesh/tet_lattice.hpp"

namespace tessera::mesh {

/// @brief Where the lattice points of a tet's faces stand in its triangles' own lattices, whose
/// corners are in ascending order.
class TetFaceMap {
 public:
  TetFaceMap(const TetComplex& complex, LocalIndex tet);

  /// @brief The triangle opposite to corner `c`: row of complex.faces.
  [[nodiscard]] LocalIndex triangle(std::size_t c) const { return triangles_[c]; }

  /// @brief Point `p` of that triangle as a point of the tet. n: intervals of an edge.
  [[nodiscard]] lattice::TetPoint tet_point(LocalIndex n, std::size_t c,
                                            const lattice::TrianglePoint& p) const;

  /// @brief Point `p` of the tet as a point of that triangle. @pre p lies on it.
  [[nodiscard]] lattice::TrianglePoint triangle_point(LocalIndex n, std::size_t c,
                                                      const lattice::TetPoint& p) const;

 private:
  std::array<LocalIndex, 4> triangles_{};
  std::array<std::array<std::size_t, 3>, 4> corners_{};  ///< Tet corners in the triangle's order.
};

}  // namespace tessera::mesh
