// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "optimize/working_mesh.hpp"

namespace tessera::optimize {

// Tets that give way to others inside the same boundary.
struct Replacement {
  std::span<const LocalIndex> old_tets;
  std::span<const TetVertices> new_tets;
  std::span<const double> new_energies;  // Of the new tets.
};

// Puts the new tets into the mesh and flags what has changed. The old ones' slots are used first,
// then free ones, then new ones at the end.
//
// False, and nothing is done, if the boundaries differ. That is so where a mesh overlaps itself,
// and an edge or a vertex has one neighbour twice. So it is, too, if more outer faces than before
// would share a tet with another one of their group.
[[nodiscard]] bool replace_tets(WorkingMesh& mesh, const Replacement& change);

}  // namespace tessera::optimize
