// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>

#include "tessera/base/vec3.hpp"

namespace tessera {

/// @brief What turns a chord into the tangent at its begin, if added to it: of the circle through
/// both ends and a point beside the middle. The tangent is as long as the chord is along it. At the
/// end it is to be added to the chord the other way round. Local.
/// @param[in] bow From the chord's middle to the circle's. Beyond an arc of 155 degrees, as there.
[[nodiscard]] inline Vec3 arc_turn(const Vec3& chord, const Vec3& bow)
{
  // Of the parabola through the three points; the tangent of a quarter of the arc is half of it.
  const double slope = std::min(4.0 * norm(bow) / norm(chord), 1.6);
  return (4.0 / (1.0 - 0.25 * slope * slope)) * bow;
}

}  // namespace tessera
