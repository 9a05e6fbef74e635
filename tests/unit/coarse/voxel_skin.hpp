// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <functional>

#include "tessera/surface/coarse_surface.hpp"

namespace tessera::testing {

/// @brief The skin of some cells of a grid of n^3 cubes of side `side`, from the origin on. Each of
/// its squares is divided along the diagonal that insphere_untied() chooses, so that Delaunay tets
/// have its triangles; the largest edge is that diagonal.
[[nodiscard]] surface::DomainSkin voxel_skin(
    int n, double side, const std::function<bool(const std::array<int, 3>& cell)>& is_inside);

/// @brief The whole grid.
[[nodiscard]] surface::DomainSkin cube_skin(int n, double side);

/// @brief The grid without the quarter where x and y are high. @pre n is even.
[[nodiscard]] surface::DomainSkin l_shape_skin(int n, double side);

/// @brief cube_skin(n, 2 / n) pushed onto the unit sphere around the origin. Delaunay tets do not
/// have all of its triangles.
[[nodiscard]] surface::DomainSkin ball_skin(int n);

}  // namespace tessera::testing
