// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "tessera/base/hash.hpp"
#include "tessera/mesh/coarse_mesh.hpp"
#include "tessera/mesh/mesh_arrays.hpp"
#include "tessera/mesh/piece.hpp"
#include "tessera/mesh/skeleton.hpp"
#include "tessera/number/id_layout.hpp"

#include "pipeline/improved_pieces.hpp"

namespace tessera::pipeline {

/// @brief What the write stage needs to turn pieces into files. Borrowed.
struct WriteContext {
  const mesh::CoarseMesh& coarse;
  const mesh::Skeleton& skeleton;
  const number::IdLayout& ids;
  const std::string& length_unit;  ///< Of the output; empty if nobody knows it.
  /// Where the pieces are and who owns their vertices, if seams were improved: `ids` is by owner
  /// then. Else nullptr.
  const ImprovedPieces* improved = nullptr;
};

/// @brief What the files of one piece hold.
struct PieceArrays {
  mesh::MeshArrays tets{};
  mesh::MeshArrays boundary{};
};

/// @brief A piece with global ids, owners, material, patches and names; an empty piece gives the
/// schema. Local.
/// @param[in] with_quality Add the mean ratio of every tet.
[[nodiscard]] PieceArrays piece_arrays(mesh::Piece piece, const WriteContext& mesh,
                                       bool with_quality);

/// @brief Sum of hash_tet() over the cells. Local. @pre ids and "attribute" are there.
[[nodiscard]] Hash128 digest_of(const mesh::MeshArrays& tets);

}  // namespace tessera::pipeline
