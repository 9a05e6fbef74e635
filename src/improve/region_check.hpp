// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "tessera/base/types.hpp"
#include "tessera/improve/optimizer.hpp"
#include "tessera/improve/region_mesh.hpp"

namespace tessera::improve {

// Throws MeshError unless the tets fill what the region's tets fill. The boundary is the same,
// triangle for triangle; the bits of the fixed vertices are unchanged; all tets are positive; the
// volume is the same (rel. 1e-9). Returns the tet behind each boundary triangle.
[[nodiscard]] std::vector<LocalIndex> check_tets(const RegionMesh& mesh, const TetMesh& tets);

}  // namespace tessera::improve
