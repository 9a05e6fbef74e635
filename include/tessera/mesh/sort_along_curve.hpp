// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tessera/mesh/coarse_mesh.hpp"

namespace tessera::mesh {

/// @brief Numbers vertices and tets anew, along a space curve: what is near in space is then near
/// in memory, where all later stages look for it. Nothing else changes. Local; linear.
/// @pre The mesh has no images and no layers.
void sort_along_curve(CoarseMesh& mesh);

}  // namespace tessera::mesh
