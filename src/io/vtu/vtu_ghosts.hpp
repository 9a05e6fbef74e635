// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tessera/mesh/mesh_arrays.hpp"

namespace tessera::io {

inline constexpr const char* kGhostName = "vtkGhostType";

/// @brief Leaves out the cells that are copies of another piece's, as "vtkGhostType" says, with the
/// points that only they use, and the array itself. Local.
void drop_ghosts(mesh::MeshArrays& mesh);

}  // namespace tessera::io
