// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "tessera/base/vec3.hpp"
#include "tessera/model/stl_file.hpp"

namespace tessera::testing {

/// @brief The 12 outward triangles of an axis-parallel cube, one solid without a name.
[[nodiscard]] model::TriangleSoup cube_soup(const Vec3& low = {0.0, 0.0, 0.0}, double side = 1.0);

/// @brief Octahedron whose triangles are split `levels` times, corners put on the unit sphere.
[[nodiscard]] model::TriangleSoup sphere_soup(int levels);

/// @brief Both soups in one, each with its own solids.
[[nodiscard]] model::TriangleSoup joined(const model::TriangleSoup& a,
                                         const model::TriangleSoup& b);

/// @brief Turns triangle `t` round.
void turn_triangle(model::TriangleSoup& soup, LocalIndex t);

/// @brief Removes triangle `t`.
void remove_triangle(model::TriangleSoup& soup, LocalIndex t);

/// @brief The soup as an ASCII file, one `solid` after the other; %.17g, so no digit is lost.
[[nodiscard]] std::string ascii_stl(const model::TriangleSoup& soup);

/// @brief The soup as a binary file, rounded to single precision.
/// @param header  First bytes, at most 80.
[[nodiscard]] std::string binary_stl(const model::TriangleSoup& soup,
                                     const std::string& header = "binary STL");

}  // namespace tessera::testing
