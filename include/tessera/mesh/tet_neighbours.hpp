// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "tessera/base/types.hpp"

namespace tessera::mesh {

/// @brief What lies across each face of the tets of a mesh. Local; expected linear time.
/// @param[in] tet_vertices  Shape (num_tets, 4): each below `num_vertices`; tets are positive.
/// @param[in] tet_name  Shape (num_tets), or empty: what errors call the tets; else their rows.
/// @return Shape (num_tets, 4): 4 u + d if the face opposite to corner c of a tet is opposite to
/// corner d of tet u; kNoIndex on the boundary.
/// @throws MeshError if a triangle belongs to more than two tets, or two lie on the same side of
/// it.
[[nodiscard]] std::vector<LocalIndex> find_tet_neighbours(
    std::span<const LocalIndex> tet_vertices, LocalIndex num_vertices,
    std::span<const LocalIndex> tet_name = {});

}  // namespace tessera::mesh
