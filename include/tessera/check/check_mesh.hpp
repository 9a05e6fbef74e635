// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>

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
  /// Only some pieces of the mesh were made: ids need not be dense, and a triangle on one tet that
  /// the boundary file lacks is an open seam, counted but no defect. Needs a boundary file to tell
  /// the two apart.
  bool is_partial = false;
};

/// @brief Verifies a tet mesh in pieces, and its boundary file if there is one, from the arrays
/// alone; trusts nothing of what made them.
///
/// Checked: sizes of arrays and ranges of indices; finite points; positive volumes; every triangle
/// on one tet or on two with opposite orientation; one position per point id and one id per
/// position; ids of points and cells dense from 0, no cell id twice; no unused points; every
/// boundary edge on an even number of boundary triangles, and none folded onto another, as at a
/// hanging node. The boundary file must hold every boundary triangle once, with outward orientation
/// and the right tet and subdomain; besides these only triangles between two materials.
///
/// Points are matched by id. If ids are absent in some piece, not dense, or contradicted by the
/// positions of most shared points, they are matched by the bits of their positions instead.
/// Positions of inner points are compared within their piece only; that pieces overlap in space
/// without sharing points is not detected.
///
/// A subdomain is what the cell array "subdomain" says, so a piece may hold several; a piece
/// without that array is one subdomain, of the piece's number.
///
/// A defect of the mesh is not an exception: it is in the report.
///
/// Piece p is read by rank p mod size, twice if it has seam tets and is not the rank's only one.
/// Memory: the largest piece about four times; the surfaces of 32 pieces, spread over the ranks; of
/// the surfaces of the pieces before, the triangles on the boundary, at interfaces and towards
/// pieces not read yet, one record of each different vertex and 16 bytes of each seam triangle; all
/// vertices if points are matched by position. So it is small where neighbours in space have
/// neighbouring numbers, and right in any order.
/// @note Collective.
/// @param[in] boundary Pieces of triangles, or nullptr if there is no boundary file.
/// @throws InputError on all ranks if a piece cannot be read.
[[nodiscard]] CheckReport check_mesh(const PieceSource& tets, const PieceSource* boundary,
                                     const comm::Communicator& comm,
                                     const CheckOptions& options = {});

}  // namespace tessera::check
