// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "cut/part_surface.hpp"

namespace tessera::cut {

/// What planes of one direction have below them, at offsets of equal distance.
struct Profile {
  double first = 0.0;            ///< Offset of entry 0.
  double step = 0.0;             ///< Between entries.
  std::vector<double> volume{};  ///< Below each plane.
  std::vector<double> area{};    ///< Of the cut.

  [[nodiscard]] double offset(std::size_t entry) const
  {
    return first + static_cast<double>(entry) * step;
  }
};

/// @brief Volumes and areas of num_entries planes, from the part's lowest to its highest point.
/// Linear in the triangles, for all planes together.
/// @param heights Of the part's points along the normal. @pre num_entries >= 2.
[[nodiscard]] Profile profile_of(const PartSurface& part, const Vec3& normal,
                                 const std::vector<double>& heights, std::size_t num_entries);

}  // namespace tessera::cut
