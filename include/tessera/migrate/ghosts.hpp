// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "tessera/base/index_lists.hpp"
#include "tessera/comm/communicator.hpp"
#include "tessera/migrate/distributed_mesh.hpp"

namespace tessera::migrate {

/// @brief Copies of tets of other parts around one part.
struct GhostTets {
  LocalIndex part = 0;
  MeshBlock block{};  ///< No boundary triangles; tet_part: the part that each is a copy from.
  std::vector<LocalIndex> vertex_owner{};  ///< Shape (block.num_vertices()); lowest part that has
                                           ///< the vertex, ghosts not counted.
};

/// @brief Finds the tets within some layers around each part. The first layer is the tets of other
/// parts that have a vertex of the part, the next one those that have a vertex of the layer before.
///
/// Each part asks the parts that have a vertex for their tets around it; answers bring the parts of
/// further vertices along. So there are two sparse exchanges a layer.
/// @note Collective.
/// @param[in] vertex_parts parts_of_vertices().
/// @return Of this rank's parts, ascending, also those without tets.
/// @pre Each part is on its rank.
[[nodiscard]] std::vector<GhostTets> find_ghosts(const comm::Communicator& comm,
                                                 const DistributedMesh& mesh,
                                                 const IndexLists& vertex_parts,
                                                 LocalIndex num_parts, int num_layers);

}  // namespace tessera::migrate
