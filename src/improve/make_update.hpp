// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "tessera/base/types.hpp"
#include "tessera/improve/optimizer.hpp"
#include "tessera/improve/region_mesh.hpp"
#include "tessera/improve/region_update.hpp"

namespace tessera::improve {

// The updates that bring a region's new tets to their owners' pieces, by owner.
// @pre an owner of a tet holds its fixed vertices.
[[nodiscard]] std::vector<PieceUpdate> make_updates(const RegionMesh& mesh, const TetMesh& tets,
                                                    const std::vector<LocalIndex>& owners);

}  // namespace tessera::improve
