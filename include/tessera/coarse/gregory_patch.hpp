// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "tessera/base/vec3.hpp"

namespace tessera::coarse {

/// @brief A curved triangle between cubic sides that meets its neighbours without a crease:
/// Walton's and Meek's quartic patch @cite walton1996.
///
/// Side c goes from corner c to the next one. Along a side the tangent plane follows from the side
/// and the normals at its ends alone. So two patches with one side and one pair of normals, of
/// either sign, have one tangent plane all along it, if the sides at a corner are at right angles
/// to its normal. An inner control point has one place for each of the two sides beside it; inside
/// of the patch it goes over from one to the other.
class GregoryPatch {
 public:
  using Corners = std::array<Vec3, 3>;
  using Sides = std::array<std::array<Vec3, 2>, 3>;  ///< Bezier's points between the corners.

  /// @param[in] normals At the corners, of length 1.
  GregoryPatch(const Corners& corners, const Sides& sides, const Corners& normals);

  /// @brief The point with these barycentric coordinates, whose sum is 1. Local.
  [[nodiscard]] Vec3 at(const std::array<double, 3>& weights) const;

 private:
  [[nodiscard]] std::array<Vec3, 2> beside(std::size_t side, const Corners& normals) const;

  Corners corners_;
  Sides sides_;
  Sides inner_{};  ///< Beside each side: near its first corner, near its second one.
};

}  // namespace tessera::coarse
