// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "tessera/mesh/coarse_mesh.hpp"

namespace tessera::layers {

/// @brief Makes the tets of every material better. Faces and segments stay, and so do all vertices
/// on them; others may be moved or merged. Local.
/// @return Shape (num_vertices): the new number of each vertex, in the same order; kNoIndex: it has
/// been merged.
[[nodiscard]] std::vector<LocalIndex> improve_interior(mesh::CoarseMesh& mesh);

}  // namespace tessera::layers
