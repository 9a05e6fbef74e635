// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "tessera/base/vec3.hpp"

namespace tessera::model {

/// @brief Solid angle under which a triangle is seen from `p`, positive from behind: 4 pi for all
/// of an outward surface seen from inside, 0 from outside. @cite vanoosterom1983 Local.
[[nodiscard]] double solid_angle(const std::array<Vec3, 3>& corners, const Vec3& p);

}  // namespace tessera::model
