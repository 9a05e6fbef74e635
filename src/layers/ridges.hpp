// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "tessera/base/vec3.hpp"
#include "tessera/mesh/coarse_mesh.hpp"

#include "layers/wall_surface.hpp"

namespace tessera::layers {

/// @brief An edge between two triangles of walls that is too sharp for one column: is_ridge().
struct Ridge {
  std::array<LocalIndex, 2> edge{};  ///< Vertices of the coarse mesh, ascending.
  Vec3 middle{};                     ///< Into the material, between the walls; of length 1.
};

/// @brief All of them, by edge. Local; O(n log n).
[[nodiscard]] std::vector<Ridge> find_ridges(const mesh::CoarseMesh& mesh,
                                             const WallSurface& walls);

/// @brief Divides edges through the material that tets at ridges have, and whose ends are both on
/// walls or periodic sides: so there are other vertices all around a ridge, for a wake to go over.
/// Local; O(n log n).
void divide_at_ridges(const WallSurface& walls, mesh::CoarseMesh& mesh);

}  // namespace tessera::layers
