// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/refine/choose_levels.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

#include "tessera/mesh/tet_edges.hpp"
#include "tessera/mesh/tet_topology.hpp"

namespace tessera::refine {
namespace {

constexpr double kLongestPart = 1.35;  // In wanted lengths, of an edge that is split straight.

std::int8_t level_for(double num_wanted, int most)
{
  int level = 0;
  while (level < most && std::ldexp(kLongestPart, level) < num_wanted) ++level;
  return static_cast<std::int8_t>(level);
}

// Row of each edge of each tet. Shape (num_tets, 6).
std::vector<LocalIndex> edges_of_tets(const mesh::CoarseMesh& coarse,
                                      const std::vector<LocalIndex>& edges)
{
  std::vector<LocalIndex> first_with(at(coarse.num_vertices()) + 1, 0);  // By the lower vertex.
  for (std::size_t row = 0; 2 * row < edges.size(); ++row) ++first_with[at(edges[2 * row]) + 1];
  for (std::size_t v = 1; v < first_with.size(); ++v) first_with[v] += first_with[v - 1];
  const auto row_of = [&](LocalIndex a, LocalIndex b) {
    LocalIndex row = first_with[at(std::min(a, b))];
    while (edges[2 * at(row) + 1] != std::max(a, b)) ++row;
    return row;
  };
  std::vector<LocalIndex> rows;
  rows.reserve(mesh::kTetEdgeCorners.size() * at(coarse.num_tets()));
  for (LocalIndex t = 0; t < coarse.num_tets(); ++t) {
    const auto tet = coarse.tet(t);
    for (const auto& [a, b] : mesh::kTetEdgeCorners) rows.push_back(row_of(tet[a], tet[b]));
  }
  return rows;
}

// Only ever higher, and the least that keeps the rule: so the order of the tets does not matter.
void raise_beside_higher(const std::vector<LocalIndex>& edges_of_tets,
                         std::vector<std::int8_t>& levels)
{
  constexpr std::size_t kEdges = mesh::kTetEdgeCorners.size();
  for (bool has_changed = true; has_changed;) {
    has_changed = false;
    for (std::size_t first = 0; first < edges_of_tets.size(); first += kEdges) {
      std::int8_t largest = 0;
      for (std::size_t e = 0; e < kEdges; ++e) {
        largest = std::max(largest, levels[at(edges_of_tets[first + e])]);
      }
      for (std::size_t e = 0; e < kEdges; ++e) {
        std::int8_t& level = levels[at(edges_of_tets[first + e])];
        if (level + 1 >= largest) continue;
        level = static_cast<std::int8_t>(largest - 1);
        has_changed = true;
      }
    }
  }
}

}  // namespace

std::vector<LocalIndex> coarse_edges(const mesh::CoarseMesh& coarse)
{
  std::vector<std::array<LocalIndex, 2>> edges;
  mesh::for_each_edge(coarse.tet_vertices, coarse.num_vertices(), [&](LocalIndex a, LocalIndex b) {
    edges.push_back({std::min(a, b), std::max(a, b)});
  });
  std::ranges::sort(edges);
  std::vector<LocalIndex> flat;
  flat.reserve(2 * edges.size());
  for (const auto& edge : edges) flat.insert(flat.end(), edge.begin(), edge.end());
  return flat;
}

mesh::EdgeLevels choose_levels(const mesh::CoarseMesh& coarse, std::vector<LocalIndex> edges,
                               const std::vector<double>& num_wanted, int most)
{
  std::vector<std::int8_t> levels;
  levels.reserve(num_wanted.size());
  for (const double num : num_wanted) levels.push_back(level_for(num, most));
  raise_beside_higher(edges_of_tets(coarse, edges), levels);
  return {std::move(edges), std::move(levels)};
}

}  // namespace tessera::refine
