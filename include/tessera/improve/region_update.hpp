// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <tuple>
#include <vector>

#include "tessera/base/types.hpp"
#include "tessera/mesh/piece.hpp"

namespace tessera::improve {

/// @brief The new tets of one region, by the subdomain that gets them.
///
/// A tet names a vertex of its subdomain's piece by its number there, new vertex i by -1 - i. New
/// vertices of several owners come first and are *shared*: their key is (host, i). The others are
/// interior to the piece of their owner.
struct RegionUpdate {
  LocalIndex region = kNoIndex;
  mesh::HostEntity host = 0;               ///< SeamRegions::host_of() the region.
  std::vector<LocalIndex> subdomains{};    ///< Shape (num_owners), ascending.
  std::vector<double> vertex_xyz{};        ///< Shape (num_new_vertices, 3).
  LocalIndex num_shared = 0;               ///< Of the new vertices: the vertices of `host`.
  std::vector<LocalIndex> tet_offsets{};   ///< Shape (num_owners + 1): tets of each owner.
  std::vector<LocalIndex> tet_vertices{};  ///< Shape (num_tets, 4); positive, VTK's order.

  static auto fields(auto& self)
  {
    return std::tie(self.region, self.host, self.subdomains, self.vertex_xyz, self.num_shared,
                    self.tet_offsets, self.tet_vertices);
  }

  [[nodiscard]] LocalIndex num_new_vertices() const
  {
    return static_cast<LocalIndex>(vertex_xyz.size() / 3);
  }

  friend bool operator==(const RegionUpdate&, const RegionUpdate&) = default;
};

/// @brief The piece with the tets of some regions exchanged: those with the updates' labels go, the
/// updates' come. Tets that stay come first, in their order, then the updates' in theirs; unused
/// vertices are dropped, the others keep their order, shared ones first. The triangles on the
/// geometry stay, with their new tets behind them.
/// @param[in] labels label_tets() of the piece.
/// @param[in] updates Accepted updates of regions of the piece, ascending by region; regions
/// without one keep their tets.
/// @note Local; linear in the piece, but for a sort of the triangles on the geometry.
/// @throws MeshError if a update does not fit the piece.
[[nodiscard]] mesh::Piece apply_updates(const mesh::Piece& piece,
                                        std::span<const LocalIndex> labels,
                                        std::span<const RegionUpdate> updates);

}  // namespace tessera::improve
