// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tessera/mesh/piece.hpp"
#include "tessera/subdomain/layer_tables.hpp"
#include "tessera/subdomain/piece_summary.hpp"

namespace tessera::subdomain {

// Puts what layers add to a piece into its summary, and the areas of its patches, which lie in
// front of them. Layers that are not positive are folds, whatever has filled the piece.
// @param[in,out] summary Of the piece without layers.
// Throws MeshError if a column is missing. Local.
void measure_layers(const mesh::Piece& piece, const LayerTables& tables, PieceSummary& summary);

}  // namespace tessera::subdomain
