// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/mesh/half_edges.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

namespace tessera::mesh {

IndexLists half_edges_of_edges(std::span<const LocalIndex> triangle_vertices)
{
  const auto ends = [&](LocalIndex h) {
    const LocalIndex from = triangle_vertices[at(h)];
    const LocalIndex to = triangle_vertices[at(next_in_triangle(h))];
    return std::pair(std::min(from, to), std::max(from, to));
  };
  IndexLists edges;
  FlatArray<LocalIndex>& half_edges = edges.values;
  half_edges.resize(triangle_vertices.size());
  std::iota(half_edges.begin(), half_edges.end(), 0);
  std::sort(half_edges.begin(), half_edges.end(), [&](LocalIndex a, LocalIndex b) {
    return std::pair(ends(a), a) < std::pair(ends(b), b);
  });
  for (std::size_t i = 1; i < half_edges.size(); ++i) {
    if (ends(half_edges[i]) != ends(half_edges[i - 1])) {
      edges.offsets.push_back(static_cast<LocalIndex>(i));
    }
  }
  if (!half_edges.empty()) edges.end_list();
  return edges;
}

std::vector<LocalIndex> opposite_half_edges(const IndexLists& edge_half_edges)
{
  std::vector<LocalIndex> opposite(edge_half_edges.values.size());
  for (LocalIndex e = 0; e < edge_half_edges.num_lists(); ++e) {
    const auto pair = edge_half_edges[e];
    opposite[at(pair[0])] = pair[1];
    opposite[at(pair[1])] = pair[0];
  }
  return opposite;
}

}  // namespace tessera::mesh
