// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "tessera/base/types.hpp"
#include "tessera/improve/optimizer.hpp"
#include "tessera/improve/region_mesh.hpp"

namespace tessera::improve {

// Throws MeshError unless the tets fill what the region's tets fill: same boundary, triangle for
// triangle, the bits of the fixed vertices unchanged, all tets positive, same volume (rel. 1e-9).
// Returns the tet behind each boundary triangle.
[[nodiscard]] std::vector<LocalIndex> check_tets(const RegionMesh& mesh, const TetMesh& tets);

}  // namespace tessera::improve
