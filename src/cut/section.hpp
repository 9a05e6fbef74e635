// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "cut/part_surface.hpp"

namespace tessera::cut {

/// Where a plane meets a part.
struct Section {
  double area = 0.0;
  double perimeter = 0.0;
  double shortest_edge = 0.0;  ///< Of its border, between corners; infinite without border.
  double angle_deg = 90.0;     ///< Smallest between the plane and a face or a curve, at the border.
};

/// @brief Looks at all triangles and curves that the plane crosses.
/// @param heights Of the part's points above the plane.
/// @param coarse_size Pieces of the border below 1e-3 of it have no direction.
[[nodiscard]] Section section_of(const PartSurface& part, const Plane& plane,
                                 const std::vector<double>& heights, double coarse_size);

}  // namespace tessera::cut
