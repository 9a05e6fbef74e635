// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "tessera/base/types.hpp"
#include "tessera/mesh/coarse_mesh.hpp"
#include "tessera/migrate/distributed_mesh.hpp"

namespace tessera::testing {

/// @brief What rank `rank` must hold of a mesh whose tets are on the given ranks, worked out from
/// the whole mesh by looking at everything. Ids are far apart and beyond 32 bits; each tet's part
/// is its number mod 5, and one column holds a function of its number.
[[nodiscard]] migrate::DistributedMesh share_of_mesh(const mesh::CoarseMesh& mesh,
                                                     std::span<const Rank> tet_rank, Rank rank);

/// @brief Number of the tet in the whole mesh.
[[nodiscard]] LocalIndex tet_of_id(GlobalIndex id);

}  // namespace tessera::testing
