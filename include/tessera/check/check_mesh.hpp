// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <vector>

#include "tessera/base/types.hpp"
#include "tessera/check/report.hpp"
#include "tessera/comm/communicator.hpp"
#include "tessera/mesh/mesh_arrays.hpp"

namespace tessera::check {

/// @brief Where the pieces of a mesh come from. `read` is called for one piece after the other,
/// more than once for the same piece, and must give the same arrays each time.
struct PieceSource {
  LocalIndex num_pieces = 0;
  std::function<mesh::MeshArrays(LocalIndex piece)> read{};
};

/// @brief What check_mesh() is asked for.
struct CheckOptions {
  /// Only some pieces of the mesh were made. Then ids need not be dense. A triangle on one tet that
  /// the boundary file lacks is an open seam: it is counted, but is no defect. Only a boundary file
  /// can tell the boundary from open seams, so it is needed.
  bool is_partial = false;
};

/// @brief Verifies a tet mesh in pieces, and its boundary file if there is one, from the arrays
/// alone. Trusts nothing of what made them.
///
/// Checked of the tets:
/// - sizes of arrays and ranges of indices;
/// - points are finite, and each is used;
/// - volumes are positive; of tets of second order the Jacobian is, everywhere, by its bounds;
/// - every edge of a tet of second order has one node, and every node one edge;
/// - every triangle is on one tet, or on two with opposite orientation;
/// - a point id has one position, and a position one id;
/// - ids of points and cells are dense from 0, and no cell id is there twice;
/// - every boundary edge is on an even number of boundary triangles, and none of these is folded
///   onto another, as at a hanging node.
///
/// Checked of the boundary file: it holds every boundary triangle once, with outward orientation
/// and the right tet and subdomain. Besides these it holds only triangles between two materials.
///
/// Points are matched by id. They are matched by the bits of their positions instead if ids are
/// absent in some piece, not dense, or contradicted by the positions of most shared points.
/// Positions of inner points are compared within their piece only. Pieces that overlap in space
/// without sharing points are not detected.
///
/// A subdomain is what the cell array "subdomain" says, so a piece may hold several. A piece
/// without that array is one subdomain, of the piece's number.
///
/// A defect of the mesh is not an exception: it is in the report.
///
/// Piece p is read by rank p mod size. It is read twice if it has seam tets and is not the rank's
/// only piece. The boundary file is read beside the tets for a first look at its triangles, and
/// behind all of them, its vertices first.
///
/// Memory:
/// - the largest piece about three times;
/// - the surfaces of 32 pieces, spread over the ranks;
/// - of each different vertex of the surfaces of the pieces read before: 41 bytes, and 5 to 11 for
///   its slots in a hash table;
/// - 12 bytes of each seam triangle between them;
/// - some 50 bytes a side of triangles on the boundary, at interfaces between pieces and towards
///   pieces not read yet;
/// - 24 more of those that the boundary file does not list in the piece of the same number;
/// - 24 more where the ids of cells do not ascend along their piece;
/// - 176 bytes of each triangle of an interface inside a piece, for both its sides;
/// - a part of the boundary file: where it is large, it is read several times;
/// - all vertices if points are matched by position.
///
/// So it is small where neighbours in space have neighbouring numbers. The result is right in any
/// order of pieces.
/// @note Collective.
/// @param[in] boundary Pieces of triangles, or nullptr if there is no boundary file.
/// @throws InputError on all ranks if a piece cannot be read.
[[nodiscard]] CheckReport check_mesh(const PieceSource& tets, const PieceSource* boundary,
                                     const comm::Communicator& comm,
                                     const CheckOptions& options = {});

/// @brief Adds a defect "line_edge" to the report if an edge on a line inside of solids is no edge
/// of a tet of its piece. Reads the pieces of tets once more that have such edges.
/// @note Collective. @throws InputError on all ranks if a piece cannot be read.
/// @param[in] lines Pieces of edges. @param[in] piece_of_lines Of each, the piece of tets.
void check_lines(const PieceSource& tets, const PieceSource& lines,
                 const std::vector<LocalIndex>& piece_of_lines, const comm::Communicator& comm,
                 CheckReport& report);

}  // namespace tessera::check
