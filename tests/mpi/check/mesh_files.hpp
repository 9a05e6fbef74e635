// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "tessera/check/check_mesh.hpp"
#include "tessera/mesh/coarse_mesh.hpp"
#include "tessera/mesh/mesh_arrays.hpp"

namespace tessera::testing {

/// @brief The pieces that a mesh file and its boundary file would hold.
struct MeshFiles {
  std::vector<mesh::MeshArrays> tets{};
  std::vector<mesh::MeshArrays> boundary{};
};

/// @brief Cuts a mesh of the unit cube into slices normal to x, one piece each, with all ids and
/// arrays that the checker knows. Ids of points are numbered piece by piece, those of tets as well.
[[nodiscard]] MeshFiles slice(const mesh::CoarseMesh& mesh, int num_pieces);

/// @brief The same mesh in fewer files: file f has the pieces first[f]…first[f+1]-1, its points
/// merged, and the cell array "subdomain" that says which piece each cell was.
[[nodiscard]] MeshFiles merge(const MeshFiles& files, const std::vector<std::size_t>& first);

/// @brief Source that hands out copies. @pre `pieces` outlives it.
[[nodiscard]] check::PieceSource source_of(const std::vector<mesh::MeshArrays>& pieces);

/// @brief Row of the point with that id. @pre the piece has it.
[[nodiscard]] std::size_t row_of_point(const mesh::MeshArrays& piece, GlobalIndex id);

/// @brief An id that both pieces have. @pre they share a point.
[[nodiscard]] GlobalIndex shared_point(const mesh::MeshArrays& a, const mesh::MeshArrays& b);

}  // namespace tessera::testing
