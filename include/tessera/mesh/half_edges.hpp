// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "tessera/base/index_lists.hpp"
#include "tessera/base/types.hpp"

namespace tessera::mesh {

// Half-edge h = 3 t + c runs from corner c of triangle t to the next corner of t.

[[nodiscard]] constexpr LocalIndex next_in_triangle(LocalIndex half_edge) noexcept
{
  return half_edge % 3 == 2 ? half_edge - 2 : half_edge + 1;
}

/// @brief The half-edges on each edge, whatever their direction. Edges come in the order of their
/// lower, then higher vertex; an edge's half-edges ascend.
/// @param triangle_vertices  Shape (num_triangles, 3).
[[nodiscard]] IndexLists half_edges_of_edges(std::span<const LocalIndex> triangle_vertices);

/// @brief For each half-edge, the other one on its edge. @pre every edge has exactly two.
[[nodiscard]] std::vector<LocalIndex> opposite_half_edges(const IndexLists& edge_half_edges);

}  // namespace tessera::mesh
