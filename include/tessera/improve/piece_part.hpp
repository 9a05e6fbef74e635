// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <tuple>
#include <vector>

#include "tessera/base/types.hpp"
#include "tessera/improve/seam_regions.hpp"
#include "tessera/mesh/piece.hpp"

namespace tessera::improve {

/// @brief Some tets of a piece, or all of them.
///
/// Vertices and tets have *tags*, numbers that no update changes. Those of the piece as it was
/// filled are its own numbers. Updates give new ones, in their order. So two parts of a piece, and
/// the piece itself, name the same vertex the same way.
struct PiecePart {
  mesh::Piece piece{};  ///< In numbers of its own; triangles on the geometry only if it is whole.
  std::vector<LocalIndex> vertex_tag{};  ///< Shape (num_vertices); ascending on the skin, and
                                         ///< ascending inside.
  std::vector<LocalIndex> tet_tag{};     ///< Shape (num_tets), ascending.
  LocalIndex num_vertex_tags = 0;        ///< Given so far.
  LocalIndex num_tet_tags = 0;
  bool is_complete = false;  ///< It has all that updates may name.
  bool is_whole = false;     ///< It has all tets of the piece; then it is complete.

  static auto fields(auto& self)
  {
    return std::tie(self.piece, self.vertex_tag, self.tet_tag, self.num_vertex_tags,
                    self.num_tet_tags, self.is_complete, self.is_whole);
  }
};

/// @brief A piece as it was filled. Local.
[[nodiscard]] PiecePart whole_piece(mesh::Piece piece);

/// @brief How far around the seams of later phases a part reaches, in layers of tets: those that
/// such a phase optimises, those beside them, and some more because a phase before it changes tets.
inline constexpr int kRimLayers = 6;

/// @brief The *rim* of a part: its tets within `layers` of the regions of the phases after `phase`.
/// Later phases need no others. Local; linear.
[[nodiscard]] PiecePart rim_of(const PiecePart& part, const SeamRegions& regions, int phase,
                               int layers = kRimLayers);

}  // namespace tessera::improve
