// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "tessera/base/index_lists.hpp"
#include "tessera/base/vec3.hpp"
#include "tessera/mesh/coarse_mesh.hpp"

namespace tessera::layers {

/// @brief A vertex on ridges, and the wake around it.
struct RidgeVertex {
  LocalIndex vertex = kNoIndex;      ///< Of the coarse mesh.
  std::vector<LocalIndex> ridges{};  ///< One where they end at a patch without layers, else two.
  Vec3 normal{};                     ///< Of the plane in the middle between the walls; of length 1.
  std::vector<LocalIndex> way{};     ///< The other vertices of the wake's triangles, in order.
};

/// @brief Puts the vertices inside that wakes have into the middle between the walls, as far as
/// tets stay good: the flatter a wake is, the steeper are its columns. Local.
/// @param[in] tets_at Of each vertex. @param[in] is_on_surface Shape (num_vertices): they stay.
void flatten_wakes(std::span<const RidgeVertex> wakes, const IndexLists& tets_at,
                   std::span<const char> is_on_surface, mesh::CoarseMesh& mesh);

}  // namespace tessera::layers
