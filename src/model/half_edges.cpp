// SPDX-License-Identifier: BSD-3-Clause
#include "half_edges.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

namespace tessera::model {

HalfEdgesOfEdges half_edges_of_edges(std::span<const LocalIndex> triangle_vertices)
{
  const auto ends = [&](LocalIndex h) {
    const LocalIndex from = triangle_vertices[static_cast<std::size_t>(h)];
    const LocalIndex to = triangle_vertices[static_cast<std::size_t>(next_in_triangle(h))];
    return std::pair(std::min(from, to), std::max(from, to));
  };
  HalfEdgesOfEdges edges;
  edges.half_edges.resize(triangle_vertices.size());
  std::iota(edges.half_edges.begin(), edges.half_edges.end(), 0);
  std::sort(edges.half_edges.begin(), edges.half_edges.end(), [&](LocalIndex a, LocalIndex b) {
    return std::pair(ends(a), a) < std::pair(ends(b), b);
  });
  for (std::size_t i = 0; i < edges.half_edges.size(); ++i) {
    if (i == 0 || ends(edges.half_edges[i]) != ends(edges.half_edges[i - 1])) {
      edges.offsets.push_back(static_cast<LocalIndex>(i));
    }
  }
  edges.offsets.push_back(static_cast<LocalIndex>(edges.half_edges.size()));
  return edges;
}

std::vector<LocalIndex> opposite_half_edges(const HalfEdgesOfEdges& edges)
{
  std::vector<LocalIndex> opposite(edges.half_edges.size());
  for (LocalIndex e = 0; e < edges.num_edges(); ++e) {
    const auto pair = edges.of(e);
    opposite[static_cast<std::size_t>(pair[0])] = pair[1];
    opposite[static_cast<std::size_t>(pair[1])] = pair[0];
  }
  return opposite;
}

}  // namespace tessera::model
