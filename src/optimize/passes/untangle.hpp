// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "optimize/working_mesh.hpp"

namespace tessera::optimize {

// Makes flat and inverted tets positive, as far as it can. It moves the vertices of bad tets, and
// tries swaps and collapses that leave positive tets only. Nothing happens if all are positive.
void untangle(WorkingMesh& mesh);

// The same by moving vertices alone: tets keep their corners.
void untangle_by_moving(WorkingMesh& mesh);

}  // namespace tessera::optimize
