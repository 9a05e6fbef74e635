// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "tessera/mesh/piece.hpp"
#include "tessera/subdomain/piece_summary.hpp"

namespace tessera::subdomain {

/// @brief Adds the lengths of a piece's edges to a histogram. Local.
/// @return The number of edges.
GlobalIndex measure_edges(const mesh::Piece& piece, quality::QualityHistograms& histograms);

/// @brief Puts the shapes of a piece's tets into its summary and histograms. Local.
/// @param[in] on_seam Shape (num_skin_vertices): whether tets there are seam tets.
void measure_tets(const mesh::Piece& piece, const std::vector<char>& on_seam, FillResult& result);

}  // namespace tessera::subdomain
