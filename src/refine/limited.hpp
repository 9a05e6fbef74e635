// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tessera/base/vec3.hpp"

namespace tessera::refine {

/// @brief As far from the chord towards the projection as the factor says.
[[nodiscard]] inline Vec3 limited(const Vec3& chord, const Vec3& projected, double factor)
{
  return factor == 1.0 ? projected : chord + factor * (projected - chord);
}

}  // namespace tessera::refine
