// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tessera/mesh/coarse_mesh.hpp"

namespace tessera::testing {

/// @brief Unit cube cut into 6 n^3 tets (Kuhn); the smallest conforming mesh with known
/// numbers. Patches 0…5 are x=0, x=1, y=0, y=1, z=0, z=1; its 12 edges are curves 0…11; one
/// material.
[[nodiscard]] mesh::CoarseMesh kuhn_cube(int n);

/// @brief kuhn_cube(n) whose tets with a centroid beyond x = 1/2 are material 2, with the faces
/// between the materials on patch 6. @pre n is even.
[[nodiscard]] mesh::CoarseMesh two_material_cube(int n);

/// @brief Of all tets.
[[nodiscard]] double volume_of(const mesh::CoarseMesh& mesh);

}  // namespace tessera::testing
