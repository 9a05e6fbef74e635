// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <tuple>
#include <vector>

#include "tessera/base/types.hpp"
#include "tessera/improve/piece_part.hpp"
#include "tessera/mesh/host_layout.hpp"

namespace tessera::improve {

/// @brief The new tets that one piece gets from one region.
///
/// A tet names a vertex of the piece by its tag, new vertex i by -1 - i. New vertices that several
/// pieces share come first: their key is (host, shared_index). The others are interior to the
/// piece.
struct PieceUpdate {
  LocalIndex region = kNoIndex;
  mesh::HostEntity host = 0;               ///< SeamRegions::host_of() the region.
  std::vector<double> vertex_xyz{};        ///< Shape (num_new_vertices, 3).
  std::vector<LocalIndex> shared_index{};  ///< Shape (num_shared), ascending.
  std::vector<LocalIndex> tet_vertices{};  ///< Shape (num_tets, 4); positive, VTK's order.

  static auto fields(auto& self)
  {
    return std::tie(self.region, self.host, self.vertex_xyz, self.shared_index, self.tet_vertices);
  }

  [[nodiscard]] LocalIndex num_new_vertices() const
  {
    return static_cast<LocalIndex>(vertex_xyz.size() / 3);
  }
  [[nodiscard]] LocalIndex num_shared() const
  {
    return static_cast<LocalIndex>(shared_index.size());
  }
  [[nodiscard]] LocalIndex num_tets() const
  {
    return static_cast<LocalIndex>(tet_vertices.size() / 4);
  }

  friend bool operator==(const PieceUpdate&, const PieceUpdate&) = default;
};

/// @brief The tets that a piece gives for an update.
struct RegionExchange {
  std::vector<LocalIndex> old_tets{};  ///< Tags, ascending: all that the piece had in the region.
  PieceUpdate update{};
};

/// @brief A part of a piece with the tets of some regions exchanged. Tets that stay come first, in
/// their order, then the updates' in theirs; unused vertices are dropped, the others keep their
/// order, shared ones first. New vertices and tets get the next tags. The triangles on the geometry
/// stay, with their new tets behind them.
///
/// A part that is not complete may lack vertices that a new tet has. It then does without that tet.
/// @param[in] exchanges Of accepted updates, ascending by phase and region; an exchange may name
/// tags that those before it have given. All updates of these phases: else tags would differ.
/// @note Local; O(n log n) in the tets of the updates and in the triangles on the geometry, linear
/// in the part.
/// @throws MeshError if an update does not fit the piece.
[[nodiscard]] PiecePart apply_updates(const PiecePart& part,
                                      std::span<const RegionExchange> exchanges);

}  // namespace tessera::improve
