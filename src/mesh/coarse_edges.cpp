// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/mesh/coarse_edges.hpp"

#include <algorithm>
#include <array>

#include "tessera/mesh/tet_edges.hpp"

namespace tessera::mesh {

std::vector<LocalIndex> coarse_edges(const CoarseMesh& coarse)
{
  std::vector<std::array<LocalIndex, 2>> edges;
  for_each_edge(coarse.tet_vertices, coarse.num_vertices(), [&](LocalIndex a, LocalIndex b) {
    edges.push_back({std::min(a, b), std::max(a, b)});
  });
  std::ranges::sort(edges);
  std::vector<LocalIndex> flat;
  flat.reserve(2 * edges.size());
  for (const auto& edge : edges) flat.insert(flat.end(), edge.begin(), edge.end());
  return flat;
}

}  // namespace tessera::mesh
