// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <limits>

#include "tessera/base/vec3.hpp"

namespace tessera::coarse {

inline constexpr double kNoTet = std::numeric_limits<double>::infinity();

// Mean energy eta^-3 of a tet's children after some levels, eta being the mean ratio; kNoTet unless
// the tet is positive. Children have the shape of the tet itself or one of the four shapes into
// which its inner octahedron is cut, along the shortest diagonal.
[[nodiscard]] double child_energy(const std::array<Vec3, 4>& corners);

}  // namespace tessera::coarse
