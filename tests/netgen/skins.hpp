// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tessera/fill/kernel.hpp"

namespace tessera::testing {

/// @brief Surface of kuhn_cube(n) with size samples at the centroids of its tets; the wanted edge
/// is the mean edge of the surface.
[[nodiscard]] fill::FillInput cube_skin(int n);

/// @brief Icosahedron, each triangle cut into 4^levels, on the unit sphere: edges of nearly one
/// length, which is the wanted one, with size samples on a grid of that width.
[[nodiscard]] fill::FillInput sphere_skin(int levels);

/// @brief Mean length of the triangles' edges.
[[nodiscard]] double mean_edge(const fill::FillInput& skin);

/// @brief Volume that a closed, outward oriented surface encloses.
[[nodiscard]] double enclosed_volume(const fill::FillInput& skin);

}  // namespace tessera::testing
