// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "check/piece/surface.hpp"

namespace tessera::check {

/// @brief Edges on surfaces of pieces, as far as they are known.
struct SurfaceEdges {
  GlobalIndex num_edges = 0;   ///< Different ones of each piece.
  GlobalIndex num_halves = 0;  ///< Of these, halves of an edge between two pieces alone.
  GlobalIndex num_boundary_components = 0;  ///< Sets of triangles on one tet joined through edges.
  std::vector<EdgeRecord> shared{};         ///< Those that other pieces may have as well.
};

/// @brief Closes the edges at all of whose triangles there is a verdict. Local.
///
/// An edge of a piece may be at two triangles that both face the same other piece. In general it is
/// at two triangles of that piece too. Then the tets around it are all in these two pieces, each
/// counts one half, and nobody else need know. Where the other piece has more triangles at the
/// edge, that piece says so in its record (`twin`).
void close_edges(PieceSurface& surface, SurfaceEdges& edges);

/// @brief Closes the edges that are left. Local. @pre there is a verdict on all triangles.
/// @param[in] flags Of the surface's vertices.
/// @return The edges that no other piece has, since no other has both ends.
[[nodiscard]] std::vector<EdgeRecord> close_last_edges(PieceSurface& surface,
                                                       std::span<const VertexFlags> flags,
                                                       SurfaceEdges& edges);

}  // namespace tessera::check
