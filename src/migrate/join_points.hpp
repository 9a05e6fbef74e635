// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "tessera/base/entity_key.hpp"
#include "tessera/mesh/mesh_arrays.hpp"
#include "tessera/migrate/distributed_mesh.hpp"

namespace tessera::migrate {

/// @brief Key of point `p` of a piece.
[[nodiscard]] VertexKey key_of_point(const mesh::MeshArrays& piece, std::size_t p,
                                     VertexIdentity identity);

/// @brief Tets of some pieces with common vertices.
struct JoinedTets {
  MeshBlock block{};                     ///< Vertices by key, tets as in the pieces. No ids yet.
  std::vector<VertexKey> vertex_keys{};  ///< Shape (num_vertices), ascending.
  std::vector<GlobalIndex> first_use{};  ///< Shape (num_vertices): in which order tets use them.
  bool has_contradiction = false;        ///< Two positions with one key.
};

/// @brief Joins the points of the pieces that have the same key. Local.
/// @throws InputError if there are more than 2^29 tets.
[[nodiscard]] JoinedTets join_tets(std::span<const mesh::MeshArrays> pieces,
                                   VertexIdentity identity);

/// @throws InputError if a tet has a vertex twice.
void require_tets(const MeshBlock& block);

}  // namespace tessera::migrate
