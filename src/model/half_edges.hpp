// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "tessera/base/types.hpp"

namespace tessera::model {

// Half-edge h = 3 t + c runs from corner c of triangle t to the next corner of t.

[[nodiscard]] constexpr LocalIndex next_in_triangle(LocalIndex half_edge) noexcept
{
  return half_edge % 3 == 2 ? half_edge - 2 : half_edge + 1;
}

/// @brief Half-edges gathered by the edge they lie on, whatever their direction.
struct HalfEdgesOfEdges {
  std::vector<LocalIndex> half_edges{};  ///< Shape (3 num_triangles), edge by edge.
  std::vector<LocalIndex> offsets{};     ///< Shape (num_edges + 1), into half_edges.

  [[nodiscard]] LocalIndex num_edges() const { return static_cast<LocalIndex>(offsets.size()) - 1; }
  [[nodiscard]] std::span<const LocalIndex> of(LocalIndex edge) const
  {
    const auto e = static_cast<std::size_t>(edge);
    return std::span(half_edges)
        .subspan(static_cast<std::size_t>(offsets[e]),
                 static_cast<std::size_t>(offsets[e + 1] - offsets[e]));
  }
};

/// @brief Edges come in the order of their lower, then higher vertex; an edge's half-edges ascend.
/// @param triangle_vertices  Shape (num_triangles, 3).
[[nodiscard]] HalfEdgesOfEdges half_edges_of_edges(std::span<const LocalIndex> triangle_vertices);

/// @brief For each half-edge, the other one on its edge. @pre every edge has exactly two.
[[nodiscard]] std::vector<LocalIndex> opposite_half_edges(const HalfEdgesOfEdges& edges);

}  // namespace tessera::model
