// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tessera/base/vec3.hpp"

/// Tets whose circumscribed spheres are empty, and the tests that they are made with.
namespace tessera::delaunay {

/// @brief Coordinates that the tests are exact for: zero, or of a magnitude between these. Beyond
/// them a product of five differences could leave the range of double.
inline constexpr double kLeastCoordinate = 0x1p-147;
inline constexpr double kMostCoordinate = 0x1p150;

/// @brief Sign of tet_volume(a, b, c, d), exact: 1, 0 or -1.
///
/// Double precision decides where its error bound allows, exact sums of doubles elsewhere.
/// @cite shewchuk1997
/// @note Local; about 5 ns where double precision decides. @pre Coordinates as said above.
[[nodiscard]] int orient3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

/// @brief 1 if `e` is inside of the sphere through the corners of a positive tet, 0 on it, -1
/// outside; exact. Of a negative tet the sign is the other one.
/// @note Local; about 15 ns where double precision decides. @pre As orient3d().
[[nodiscard]] int insphere(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d,
                           const Vec3& e);

/// @brief insphere() with ties broken: 1 or -1.
///
/// As if each point were lifted off the paraboloid x^2 + y^2 + z^2 by an amount of its own. The
/// amounts are far smaller than any difference of coordinates, and ordered as the positions are:
/// the first one in lexicographic order is lifted least. So the answer depends on the positions
/// alone, and Delaunay tets with it are a function of the set of points. @cite devillers2011
/// @pre The tet is positive, and the points differ.
[[nodiscard]] int insphere_untied(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d,
                                  const Vec3& e);

/// @brief Whether three points lie on one line; exact. @note Local. @pre As orient3d().
[[nodiscard]] bool are_collinear(const Vec3& a, const Vec3& b, const Vec3& c);

}  // namespace tessera::delaunay
