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

/// @brief Source that hands out copies. @pre `pieces` outlives it.
[[nodiscard]] check::PieceSource source_of(const std::vector<mesh::MeshArrays>& pieces);

/// @brief Row of the point with that id. @pre the piece has it.
[[nodiscard]] std::size_t row_of_point(const mesh::MeshArrays& piece, GlobalIndex id);

/// @brief An id that both pieces have. @pre they share a point.
[[nodiscard]] GlobalIndex shared_point(const mesh::MeshArrays& a, const mesh::MeshArrays& b);

}  // namespace tessera::testing
