// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "tessera/base/index_lists.hpp"
#include "tessera/comm/communicator.hpp"
#include "tessera/migrate/distributed_mesh.hpp"
#include "tessera/migrate/tet_neighbours.hpp"

namespace tessera::migrate {

/// @brief Cuts the mesh into parts of equal numbers of tets with few triangles between them, by
/// PT-Scotch. @cite chevalier2008
///
/// Parts need not be connected, and in a small mesh not balanced. For a given number of ranks
/// the result is always the same.
/// @note Collective.
/// @param[in] seed Other seeds give other parts.
/// @return Shape (num_tets): part of each tet, in [0, num_parts).
/// @pre 1 <= num_parts <= number of tets on all ranks.
/// @throws MeshError on all ranks if PT-Scotch gives up; ConfigError as require_partitioner().
[[nodiscard]] std::vector<LocalIndex> partition_tets(const comm::Communicator& comm,
                                                     const DistributedMesh& mesh,
                                                     const TetNeighbours& neighbours,
                                                     LocalIndex num_parts, int seed);

/// @brief Rank that holds a part: ranks hold consecutive parts, as evenly as possible. Local.
[[nodiscard]] Rank rank_of_part(LocalIndex part, LocalIndex num_parts, int num_ranks);

/// @brief Parts that have each vertex, ascending, also those on other ranks; the first owns it.
/// @note Collective.
[[nodiscard]] IndexLists parts_of_vertices(const comm::Communicator& comm,
                                           const DistributedMesh& mesh);

/// @brief Whether this build can cut meshes into parts. Local.
/// @throws ConfigError if there is more than one part to make and no PT-Scotch; the same on all
/// ranks.
void require_partitioner(LocalIndex num_parts);

/// @brief PT-Scotch's version, e.g. "7.0.3"; "none" in a build without it.
[[nodiscard]] std::string scotch_version();

}  // namespace tessera::migrate
