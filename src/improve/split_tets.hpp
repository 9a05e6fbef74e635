// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tessera/base/types.hpp"
#include "tessera/improve/optimizer.hpp"
#include "tessera/improve/region_mesh.hpp"

namespace tessera::improve {

// Splits tets until every one of them may be given to an owner; returns the number of vertices put
// in. An edge whose fixed vertices no owner holds together gets a vertex in its middle. Triangles
// follow, then tets. That ends: the new vertices are free, so a split takes one such edge
// (triangle, tet) away and makes none of the same or a smaller number of vertices. None of them is
// on the boundary, because the owner of an old tet behind a boundary triangle holds all of it.
[[nodiscard]] LocalIndex split_disputed(const RegionMesh& mesh, TetMesh& tets);

}  // namespace tessera::improve
