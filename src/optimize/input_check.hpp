// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tessera/optimize/tet_mesh.hpp"

namespace tessera::optimize {

// What can be said of a mesh without its topology. Throws MeshError naming the tet whose index is
// out of range, or whose corner is not finite, or the array that does not fit.
void require_valid_arrays(const TetMesh& mesh);

}  // namespace tessera::optimize
