// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "tessera/base/types.hpp"
#include "tessera/mesh/coarse_mesh.hpp"

namespace tessera::cut {

/// @brief The coarse mesh of a model that was cut before it was meshed. Surfaces, curves, patches
/// and materials are those of the uncut model: between two parts there is nothing of them.
struct CutMesh {
  mesh::CoarseMesh mesh{};
  std::vector<LocalIndex> tet_part{};  ///< Shape (num_tets); parts of the CutTree.
};

}  // namespace tessera::cut
