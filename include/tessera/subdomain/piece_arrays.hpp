// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "tessera/base/hash.hpp"
#include "tessera/mesh/coarse_mesh.hpp"
#include "tessera/mesh/mesh_arrays.hpp"
#include "tessera/mesh/piece.hpp"
#include "tessera/mesh/skeleton.hpp"
#include "tessera/number/id_layout.hpp"
#include "tessera/subdomain/layer_tables.hpp"
#include "tessera/subdomain/mesh_part.hpp"

namespace tessera::subdomain {

/// @brief Who numbers a vertex.
struct VertexPlace {
  LocalIndex owner = kNoIndex;  ///< Subdomain.
  LocalIndex index = 0;         ///< Among the vertices that it owns.
};

/// @brief What the write stage needs to turn pieces into files. Borrowed.
struct WriteContext {
  const mesh::CoarseMesh& coarse;
  const mesh::Skeleton& skeleton;
  const number::IdLayout& ids;
  const std::string& length_unit;  ///< Of the output; empty if nobody knows it.
  /// Who owns the vertices of a piece, shape (num_vertices). Needed where `ids` is by owner, as it
  /// is once seams were improved.
  std::function<std::vector<VertexPlace>(const mesh::Piece&)> places_of{};
  /// The same of vertices of the skeleton, whatever piece has them. Needed at joints.
  std::function<std::vector<VertexPlace>(std::span<const mesh::HostPoint>)> places_of_names{};
  const LayerTables* layers = nullptr;  ///< Of a mesh with layers.

  /// @brief Vertices of the whole mesh, those of layers last.
  [[nodiscard]] GlobalIndex num_vertices() const
  {
    return ids.num_vertices() + (layers == nullptr ? 0 : layers->num_points());
  }
};

/// @brief What the files of one piece hold.
struct PieceArrays {
  mesh::MeshArrays tets{};
  mesh::MeshArrays boundary{};
  mesh::MeshArrays lines{};  ///< Edges on lines inside of solids; no arrays if there are none.
};

/// @brief Names of patches, by row of the files: patches of one row have one name. Local.
[[nodiscard]] std::vector<std::string> names_of_rows(const mesh::CoarseMesh& coarse);

/// @brief A piece with global ids, owners, material, patches and names; an empty piece gives the
/// schema. Local.
/// @param[in] with_quality Add the mean ratio of every tet.
[[nodiscard]] PieceArrays piece_arrays(mesh::Piece piece, const WriteContext& mesh,
                                       bool with_quality);

/// @brief The same for programs, with triangles that refer to the points of the tets. Local.
/// @param[in] number Of the files. @pre the tets are in ascending order of their ids.
[[nodiscard]] MeshPiece mesh_piece(PieceArrays arrays, LocalIndex number);

/// @brief Sum of hash_tet() over the cells, or of hash_quadratic_tet(). Local. @pre ids and
/// "attribute" are there.
[[nodiscard]] Hash128 digest_of(const mesh::MeshArrays& tets);

}  // namespace tessera::subdomain
