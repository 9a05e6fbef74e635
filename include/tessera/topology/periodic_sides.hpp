// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "tessera/mesh/coarse_mesh.hpp"
#include "tessera/topology/options.hpp"

/// Sides of a mesh that are images of others, as of one cell of a lattice or one blade of a wheel.
namespace tessera::topology {

/// @brief A vertex may be so far from the image of its partner, in parts of the mesh's diagonal.
inline constexpr double kMostOffImage = 1e-6;

/// @brief Finds which faces are images of which, and puts vertices exactly where the transforms
/// say: CoarseMesh::images. Vertices that are images of each other stand behind each other then.
/// Local; O(n log n).
/// @throws ConfigError if an entry fits no patch, or a patch fits two, or lies between materials.
/// @throws MeshError if sides do not match, with the place and the distance; or if a face has a
/// vertex and its image, and transforms do not commute, so that it cannot have its image's order.
void join_periodic_sides(mesh::CoarseMesh& mesh, std::span<const PeriodicSide> sides);

}  // namespace tessera::topology
