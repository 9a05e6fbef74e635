// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "tessera/layers/options.hpp"
#include "tessera/mesh/coarse_mesh.hpp"
#include "tessera/mesh/wake_triangle.hpp"

namespace tessera::layers {

/// @brief Finds where layers should go on from sharp edges of walls into the material. Local.
///
/// At an edge as that behind a wing no single column is steep enough on both walls. Triangles of
/// the tets that go on from there, about in the middle between the walls, are a *wake*. Opened
/// along it (topology::open_wakes()), an edge has two columns, one for each side: each sees a wall
/// and a side of the wake, which are nearly one plane. At the other end of its triangles the layers
/// close.
///
/// A vertex is left out if the edge ends there within walls, parts or meets another one; at splits,
/// joints and faces inside, and where several periodic sides meet; and if two columns would not be
/// steep either. Periodic sides are treated alike.
///
/// Edges of tets that go from wall to wall at a sharp edge, or to a periodic side, are divided
/// first. Vertices inside of the material that become corners of a wake move into the middle
/// between the walls.
/// @param[in] keep_tets  They are not, and they do not.
/// @pre mesh::validate() accepts the mesh; it has no layers.
/// @throws ConfigError as grow_layers().
[[nodiscard]] std::vector<mesh::WakeTriangle> find_wakes(mesh::CoarseMesh& mesh,
                                                         std::span<const LayerOptions> options,
                                                         bool keep_tets);

}  // namespace tessera::layers
