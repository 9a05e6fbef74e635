// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "tessera/mesh/piece.hpp"
#include "tessera/number/id_layout.hpp"
#include "tessera/number/surface_simplices.hpp"
#include "tessera/subdomain/piece_arrays.hpp"
#include "tessera/subdomain/refine_piece.hpp"

/// What pieces tell their neighbours before they are split further.
namespace tessera::subdomain {

/// @brief The triangles of a piece that belong to one of its tets, with their edges, and all of its
/// named vertices (some may lie inside since tets were exchanged).
/// @throws MeshError if a triangle belongs to three tets, or a vertex of the surface has no name.
/// @note Local; O(n log n) in the tets.
[[nodiscard]] number::SurfaceList surface_of(const mesh::Piece& piece);

/// @brief The tets of a piece that touch a seam: what its neighbours need for the vertices there.
/// Boundary triangles are left out. Local; linear.
/// @param[in] surface,shared Of this piece.
[[nodiscard]] mesh::Piece halo_of(const mesh::Piece& piece, const number::SurfaceList& surface,
                                  const number::SharedSurface& shared);

/// @brief Of a neighbour's halo the tets that touch a piece: its other seams are no concern of that
/// piece. Local; O(n log n). @param[in] surface Of the piece.
[[nodiscard]] mesh::Piece halo_beside(const mesh::Piece& halo, const number::SurfaceList& surface);

/// @brief What the piece will hold after the split: closed forms. Local; O(m log m) in the tets.
/// @param[in] layers With the split, of a mesh with layers; null without.
[[nodiscard]] number::PieceCounts count_split_piece(const mesh::Piece& piece,
                                                    const number::SurfaceList& surface,
                                                    const number::SharedSurface& shared,
                                                    const PieceSplit& split,
                                                    const LayerTables* layers = nullptr);

/// @brief Simplices of pieces across joints at which columns of this piece may end, by the names of
/// their vertices. Some may not exist. Local.
/// @param[in] surface Of the piece.
[[nodiscard]] number::SurfaceSimplices ends_across_joints(const number::SurfaceSimplices& surface,
                                                          const LayerTables& layers);

/// @brief Who numbers vertices by the names that pieces give them that were split. Local.
[[nodiscard]] std::vector<VertexPlace> places_of_split_names(std::span<const mesh::HostPoint> names,
                                                             const mesh::HostLayout& hosts);

/// @brief Who numbers the vertices of a piece that was split: its names say so. Local.
/// @param[in] counts Of this piece. @return Shape (num_vertices).
[[nodiscard]] std::vector<VertexPlace> places_of_split_piece(const mesh::Piece& piece,
                                                             const mesh::HostLayout& hosts,
                                                             const number::PieceCounts& counts);

}  // namespace tessera::subdomain
