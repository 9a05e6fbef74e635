// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "cut/moments.hpp"
#include "cut/part_surface.hpp"

namespace tessera::cut {

/// Normal of planes.
struct Direction {
  Vec3 normal{};
  bool is_plain =
      false;  ///< Along a coordinate axis, or one of the model: its cuts are simple curves.
};

/// @brief Normals of planes worth a look, no two of them near each other: axes of inertia,
/// coordinate axes, normals of large flat faces, axes of large round ones, and a few between.
[[nodiscard]] std::vector<Direction> candidate_directions(const PartSurface& part,
                                                          const Moments& moments);

}  // namespace tessera::cut
