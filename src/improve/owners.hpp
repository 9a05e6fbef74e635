// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "tessera/base/types.hpp"
#include "tessera/improve/optimizer.hpp"
#include "tessera/improve/region_mesh.hpp"

namespace tessera::improve {

// Gives each tet to the owner of the nearest old tet among those that may have it. Then some tets
// of an owner may not hang together with its other tets. They go to an owner beside them that may
// have them, where there is one. @pre split_disputed(): every tet may be given to somebody.
// @param[in] triangle_tet The tet behind each boundary triangle.
// Throws MeshError if an owner that had tets in the region would lose them all.
[[nodiscard]] std::vector<LocalIndex> give_to_owners(const RegionMesh& mesh, const TetMesh& tets,
                                                     const std::vector<LocalIndex>& triangle_tet);

}  // namespace tessera::improve
