// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "tessera/base/vec3.hpp"

#include "cut/part_surface.hpp"

namespace tessera::cut {

/// What a part's inside weighs, and how it lies in space.
struct Moments {
  double volume = 0.0;
  Vec3 centre{};
  std::array<Vec3, 3>
      axes{};  ///< Of inertia, of length 1; along the first one the part is longest.
};

/// @brief Integrates over the inside of a closed surface.
[[nodiscard]] Moments moments_of(const PartSurface& part);

/// @brief The volume alone.
[[nodiscard]] double volume_of(const PartSurface& part);

/// @brief Volume below a plane. @param heights Of the part's points above it.
[[nodiscard]] double volume_below(const PartSurface& part, const Vec3& normal,
                                  const std::vector<double>& heights);

/// @brief Offset at which a plane of this normal has a fraction of the part below it.
/// @param fraction In (0, 1).
[[nodiscard]] double balanced_offset(const PartSurface& part, const Vec3& normal, double fraction);

/// A symmetric matrix: xx, xy, xz, yy, yz, zz.
using Symmetric = std::array<double, 6>;

/// Eigenvalues, the largest first, and their directions. Equal ones keep the order of the
/// coordinate axes.
struct Eigen {
  Vec3 values{};
  std::array<Vec3, 3> axes{};
};
[[nodiscard]] Eigen eigen_of(const Symmetric& matrix);

/// @brief The direction, turned such that its largest component is positive.
[[nodiscard]] Vec3 turned_forward(const Vec3& direction);

}  // namespace tessera::cut
