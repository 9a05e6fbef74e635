// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "tessera/base/bytes.hpp"
#include "tessera/base/types.hpp"
#include "tessera/mesh/piece.hpp"

namespace tessera::improve {

/// @brief The new tets of one region, by the subdomain that gets them.
///
/// A tet names a vertex of its subdomain's piece by its number there, new vertex i by -1 - i. New
/// vertices of several owners come first and are *shared*: their key is (unit, i). The others are
/// interior to the piece of their owner.
struct Patch {
  LocalIndex region = kNoIndex;
  mesh::Unit unit = 0;                     ///< Regions::unit_of() the region.
  std::vector<LocalIndex> subdomains{};    ///< Shape (num_owners), ascending.
  std::vector<double> vertex_xyz{};        ///< Shape (num_new_vertices, 3).
  LocalIndex num_shared = 0;               ///< Of the new vertices: the vertices of `unit`.
  std::vector<LocalIndex> tet_offsets{};   ///< Shape (num_owners + 1): tets of each owner.
  std::vector<LocalIndex> tet_vertices{};  ///< Shape (num_tets, 4); positive, VTK's order.

  [[nodiscard]] LocalIndex num_new_vertices() const
  {
    return static_cast<LocalIndex>(vertex_xyz.size() / 3);
  }

  friend bool operator==(const Patch&, const Patch&) = default;
};

/// @brief Byte image of a patch and back. Local.
[[nodiscard]] Bytes to_bytes(const Patch& patch);
/// @throws InputError if the bytes are truncated.
[[nodiscard]] Patch patch_from_bytes(std::span<const std::byte> bytes);

/// @brief The piece with the tets of some regions exchanged: those with the patches' labels go, the
/// patches' come. Tets that stay come first, in their order, then the patches' in theirs; unused
/// vertices are dropped, the others keep their order, shared ones first. The triangles on the
/// geometry stay, with their new tets behind them.
/// @param[in] labels label_tets() of the piece.
/// @param[in] patches Accepted patches of regions of the piece, ascending by region; regions
/// without one keep their tets.
/// @note Local; linear in the piece, but for a sort of the triangles on the geometry.
/// @throws MeshError if a patch does not fit the piece.
[[nodiscard]] mesh::Piece apply_patches(const mesh::Piece& piece,
                                        std::span<const LocalIndex> labels,
                                        std::span<const Patch> patches);

}  // namespace tessera::improve
