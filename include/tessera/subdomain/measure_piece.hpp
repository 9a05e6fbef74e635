// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "tessera/improve/piece_part.hpp"
#include "tessera/mesh/piece.hpp"
#include "tessera/mesh/skin.hpp"
#include "tessera/subdomain/partitioned_mesh.hpp"
#include "tessera/subdomain/piece_summary.hpp"

namespace tessera::subdomain {

/// @brief Adds the lengths of a piece's edges to a histogram. Local.
/// @return The number of edges.
GlobalIndex measure_edges(const mesh::Piece& piece, quality::QualityHistograms& histograms);

/// @brief Adds the length of one edge, as measure_edges() does. Local.
void measure_edge(const mesh::Piece& piece, LocalIndex a, LocalIndex b,
                  quality::QualityHistograms& histograms);

/// @brief Puts the shapes of a piece's tets into its summary and histograms. Local.
/// @param[in] on_seam Shape (num_skin_vertices): whether tets there are seam tets.
void measure_tets(const mesh::Piece& piece, const std::vector<char>& on_seam, FillResult& result);

/// @brief Sum over the tets, output length unit cubed. Local.
[[nodiscard]] double volume_of(const mesh::Piece& piece);

/// @brief What a piece has of each patch, ascending. Local.
[[nodiscard]] std::vector<PatchArea> patch_areas(const mesh::Piece& piece);

/// @brief The lines that a piece has edges on, ascending. Local.
[[nodiscard]] std::vector<LineLength> line_lengths(const mesh::Piece& piece);

/// @brief What a piece as it was filled and its skin show: counts, shapes, outside and seams.
/// Without volume, kernel and the distances to the model. Local.
[[nodiscard]] FillResult measure_filled_piece(const PartitionedMesh& cut, const mesh::Skin& skin,
                                              const mesh::Piece& piece);

/// @brief The figures of a piece, or of a part of it, after it has exchanged tets with others; what
/// an exchange does not change is taken from `filled`. Without owned vertices. Local.
/// @param[in] on_seam Shape (num_skin_vertices): whether tets there are seam tets.
/// @param[in] filled The summary of the piece as it was filled.
[[nodiscard]] FillResult measure_improved_part(const improve::PiecePart& part,
                                               const std::vector<char>& on_seam,
                                               const PieceSummary& filled);

/// @brief The figures of a piece that was split further. Without volume, owned vertices and the
/// distances to the model. The Euler characteristic stays that of the fill: a piece that has
/// exchanged tets may have another one. Local.
/// @param[in] skin Of the piece; `surface` has the parents of its triangles.
/// @param[in] images Of the coarse mesh.
/// @param[in] on_seam Shape (num_skin_vertices): whether tets there are seam tets.
/// @param[in] before The summary of the piece before it was split.
[[nodiscard]] FillResult measure_split_piece(const mesh::Piece& piece, const mesh::Skin& skin,
                                             const mesh::Skeleton& surface,
                                             const mesh::SideImages& images,
                                             const std::vector<char>& on_seam,
                                             const PieceSummary& before);

}  // namespace tessera::subdomain
