// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <set>

#include "tessera/mesh/coarse_mesh.hpp"

#include "layers/wall_surface.hpp"

namespace tessera::layers {

/// @brief Two coarse vertices, ascending.
using WallEdge = std::array<LocalIndex, 2>;

/// @brief Makes columns on periodic sides alike: WallVertex::origin. Copies of a vertex at a split
/// are alike, too, where a side of it has no layers and a wall beside it has: else the sides would
/// come apart. What cannot be alike gets no column. Local; does nothing without images.
/// @param[in] on_walls Sides of the triangles of walls.
/// @pre Each vertex is its own origin, and has the column that it would have for itself.
void join_image_columns(const mesh::CoarseMesh& mesh, const std::set<WallEdge>& on_walls,
                        WallSurface& walls);

}  // namespace tessera::layers
