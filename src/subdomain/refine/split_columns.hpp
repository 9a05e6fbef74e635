// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "tessera/mesh/piece.hpp"
#include "tessera/mesh/refined_lattice.hpp"
#include "tessera/refine/lattice_refiner.hpp"
#include "tessera/subdomain/layer_tables.hpp"

#include "subdomain/refine/split_surface.hpp"

namespace tessera::subdomain {

// The columns of a piece that was split.
struct SplitColumns {
  mesh::Columns columns{};
  // Triangles of the complex on walls, before the split, whose layers are not positive.
  std::vector<LocalIndex> folded{};
};

// A new column is that of the skeleton's lattice. Where its point is held back, it is in the middle
// of its two parents', so that the layers over a triangle are parts of those before the split.
// @param[in] known, points Of `surface`, whose piece this is. @param[in] tables With the split.
// Throws GeometryError if a projection fails.
[[nodiscard]] SplitColumns split_columns(const SplitSurface& surface, const mesh::Piece& piece,
                                         const PieceSurroundings& around,
                                         const mesh::RefinedLattice& known,
                                         const mesh::RefinedLattice& points,
                                         const refine::RefineContext& refine,
                                         const LayerTables& tables);

}  // namespace tessera::subdomain
