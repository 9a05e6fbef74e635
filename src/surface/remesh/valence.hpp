// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <numbers>

#include "tessera/base/vec3.hpp"

#include "surface/editable_surface.hpp"

namespace tessera::surface {

/// @brief How many triangles of the patch a vertex has more than there is room for at 60 degrees
/// each: below 0 if it has fewer.
[[nodiscard]] inline double excess_valence(const EditableSurface& surface, LocalIndex v,
                                           LocalIndex patch)
{
  const bool is_inside = surface.freedom(v) == Freedom::patch;
  double turn = 0.0;
  int count = 0;
  for (const LocalIndex t : surface.triangles_of(v)) {
    if (surface.patch(t) != patch) continue;
    ++count;
    if (is_inside) continue;
    const auto [p, a, b] = surface.corners_from(t, v);
    turn += angle_between(a - p, b - p);
  }
  return count - (is_inside ? 6.0 : std::max(1.0, turn * 3.0 / std::numbers::pi));
}

}  // namespace tessera::surface
