// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "tessera/base/types.hpp"
#include "tessera/improve/optimizer.hpp"
#include "tessera/improve/patch.hpp"
#include "tessera/improve/region_mesh.hpp"

namespace tessera::improve {

// The patch that brings a region's new tets to their owners' pieces.
// @pre an owner of a tet holds its fixed vertices.
[[nodiscard]] Patch make_patch(const RegionMesh& mesh, const TetMesh& tets,
                               const std::vector<LocalIndex>& owners);

}  // namespace tessera::improve
