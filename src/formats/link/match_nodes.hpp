// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <tuple>
#include <vector>

#include "tessera/base/entity_key.hpp"
#include "tessera/comm/communicator.hpp"

#include "formats/piece_source.hpp"

namespace tessera::formats {

/// @brief The node of an edge that other pieces may have as well.
struct SkinNode {
  EdgeKey edge{};
  VertexKey key{};
  Vec3 position{};
  std::array<Vec3, 2> ends{};
  LocalIndex piece = 0;

  static auto fields(auto& self)
  {
    return std::tie(self.edge, self.key, self.position, self.ends, self.piece);
  }
};

/// @brief Appends the nodes of all edges of the faces that one tet of a piece has; of first order
/// there are none. Local. @param[in] behind Of tets_behind().
void add_skin_nodes(const LoadedPiece& piece, LocalIndex number,
                    const std::vector<LocalIndex>& behind, std::vector<SkinNode>& nodes);

/// @brief Refuses pieces that have different nodes on a common edge: what links pieces goes by
/// corners, and tets would come apart there without a word. @note Collective.
/// @throws InputError on all ranks, naming the files, the edge and both nodes.
void require_same_nodes(const std::vector<SkinNode>& nodes, const PieceSource& source,
                        const comm::Communicator& comm);

}  // namespace tessera::formats
