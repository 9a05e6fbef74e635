// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "cut/part_surface.hpp"

namespace tessera::cut {

/// Where planes of one direction meet something of which they should keep clear: a corner, or a
/// point at which they touch a curve or a face. Between a plane and such a point the part is thin.
struct Landmark {
  double height = 0.0;  ///< Along the normal.
  double size = 0.0;    ///< Distance that is clear.
};

/// What does not depend on the direction.
class LandmarkFinder {
 public:
  LandmarkFinder(const PartSurface& part, double coarse_size);

  /// @brief Landmarks of planes in one direction, ascending.
  [[nodiscard]] std::vector<Landmark> find(const std::vector<double>& heights) const;

 private:
  [[nodiscard]] bool touches_curve(LocalIndex v, const std::vector<double>& heights) const;

  const PartSurface& part_;
  std::vector<LocalIndex> num_edges_{};                  // At each point.
  std::vector<double> size_{};                           // Of each point.
  std::vector<std::array<LocalIndex, 2>> neighbours_{};  // Along the curve, for points inside one.
  std::vector<bool> has_triangle_{};
};

/// @brief Distance of a plane from the nearest landmark, in its size; at most `largest`.
/// @param landmarks Ascending, none of a size above `coarse_size`.
[[nodiscard]] double clearance_of(const std::vector<Landmark>& landmarks, double offset,
                                  double coarse_size, double largest);

}  // namespace tessera::cut
