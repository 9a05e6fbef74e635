// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "tessera/base/entity_key.hpp"

#include "formats/link/link_pieces.hpp"

namespace tessera::formats {

/// @brief Edges of the faces that one tet of a piece has.
struct SkinEdges {
  std::vector<EdgeKey> keys{};
  std::vector<std::array<LocalIndex, 2>> points{};  ///< Rows in the file.
};

/// @brief Those of cells: not the diagonals of prisms. Local. @param[in] behind Of tets_behind().
[[nodiscard]] SkinEdges skin_edges(const LoadedPiece& piece, const std::vector<LocalIndex>& behind);

/// @brief Finds the edges that pieces share. Their points do not say it: two pieces may share both
/// ends of an edge that only one of them has. @note Collective.
/// @param[in] edges Shape (num_pieces of this rank).
/// @param[in] first_piece Number of the first of them.
/// @param[in,out] links Of the same pieces, with shared points.
void link_edges(std::vector<SkinEdges> edges, LocalIndex first_piece,
                const comm::Communicator& comm, std::vector<PieceLinks>& links);

}  // namespace tessera::formats
