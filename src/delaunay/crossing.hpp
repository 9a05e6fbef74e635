// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "tessera/base/vec3.hpp"

namespace tessera::delaunay {

// Whether no mesh can have both the tet and the triangle: the triangle goes through the inside of
// the tet, or overlaps one of its faces and is another one. Exact.
// @pre The tet is positive, the triangle is not flat and no face of the tet.
[[nodiscard]] bool is_crossed(const std::array<Vec3, 4>& tet, const std::array<Vec3, 3>& triangle);

}  // namespace tessera::delaunay
