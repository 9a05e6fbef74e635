// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <tuple>
#include <vector>

#include "tessera/base/types.hpp"
#include "tessera/mesh/piece.hpp"

/// Who holds a vertex that several pieces share, when no closed form says it. Pieces list their
/// shared vertices, and the lowest piece that lists a vertex *owns* it.
namespace tessera::number {

/// @brief The shared vertices of a piece, ascending. Local.
[[nodiscard]] std::vector<mesh::HostPoint> shared_vertices(const mesh::Piece& piece);

/// @brief What one piece says of its vertices.
struct VertexList {
  LocalIndex subdomain = kNoIndex;
  LocalIndex material = 0;
  std::vector<mesh::HostPoint> vertices{};  ///< Ascending.

  static auto fields(auto& self) { return std::tie(self.subdomain, self.material, self.vertices); }
};

/// @brief What the lists of its neighbours say of a piece's shared vertices.
struct SharedBy {
  std::vector<mesh::HostPoint> owned{};  ///< Those that no lower piece holds, ascending.
  std::vector<char> on_seam{};  ///< Shape (num vertices): whether two pieces of one material
                                ///< hold it.
};

/// @brief Compares a piece's list with those of all pieces that may share a vertex with it. Local;
/// linear in the lists.
[[nodiscard]] SharedBy compare_lists(const VertexList& own, std::span<const VertexList> neighbours);

}  // namespace tessera::number
