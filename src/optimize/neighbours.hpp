// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "tessera/base/types.hpp"

namespace tessera::optimize {

// Throws MeshError unless `tet_neighbours` may be what mesh::find_tet_neighbours() finds. Each
// entry must be mutual, and join two tets on different sides of one triangle.
void require_neighbours(const std::vector<LocalIndex>& tet_vertices,
                        const std::vector<LocalIndex>& tet_neighbours);

}  // namespace tessera::optimize
