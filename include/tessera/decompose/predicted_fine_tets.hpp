// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "tessera/mesh/coarse_mesh.hpp"
#include "tessera/mesh/edge_levels.hpp"

namespace tessera::decompose {

/// @brief Fine tets to expect in place of each coarse tet: mesh::num_children(). Shape (num_tets).
/// Local.
///
/// Exact for subdivision. NETGEN begins with the same tets and makes them up to 7 % fewer (18
/// meshes).
[[nodiscard]] std::vector<double> predicted_fine_tets(const mesh::CoarseMesh& mesh,
                                                      const mesh::EdgeLevels& levels);

}  // namespace tessera::decompose
