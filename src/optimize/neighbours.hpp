// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "tessera/base/types.hpp"

namespace tessera::optimize {

// The corner across each face, kNoIndex on the boundary; shape (num_tets, 4). Expected linear time.
// Throws MeshError if a triangle belongs to more than two tets, or two tets lie on the same side of
// one. Tets are named by `tet_origin`.
[[nodiscard]] std::vector<LocalIndex> find_neighbours(const std::vector<LocalIndex>& tet_vertices,
                                                      LocalIndex num_vertices,
                                                      const std::vector<LocalIndex>& tet_origin);

// Throws MeshError unless `tet_neighbours` may be what find_neighbours() finds. Each entry must be
// mutual, and join two tets on different sides of one triangle.
void require_neighbours(const std::vector<LocalIndex>& tet_vertices,
                        const std::vector<LocalIndex>& tet_neighbours);

}  // namespace tessera::optimize
