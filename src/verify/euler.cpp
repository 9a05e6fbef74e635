// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/verify/euler.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

#include "tessera/mesh/tet_topology.hpp"

namespace tessera::verify {
namespace {

// Adds `sign` for every different (part, vertices...) row.
template <std::size_t N>
void count_rows(std::vector<std::array<LocalIndex, N>> rows, GlobalIndex sign,
                std::vector<GlobalIndex>& counts)
{
  std::sort(rows.begin(), rows.end());
  const auto last = std::unique(rows.begin(), rows.end());
  for (auto row = rows.begin(); row != last; ++row)
    counts[static_cast<std::size_t>((*row)[0])] += sign;
}

}  // namespace

std::vector<GlobalIndex> euler_characteristics(std::span<const LocalIndex> tet_vertices,
                                               std::span<const LocalIndex> tet_part)
{
  std::vector<std::array<LocalIndex, 2>> vertices;
  std::vector<std::array<LocalIndex, 3>> edges;
  std::vector<std::array<LocalIndex, 4>> triangles;
  LocalIndex num_parts = 0;
  for (std::size_t t = 0; t < tet_part.size(); ++t) {
    const LocalIndex part = tet_part[t];
    num_parts = std::max(num_parts, part + 1);
    const auto v = tet_vertices.subspan(4 * t, 4);
    for (const LocalIndex vertex : v) vertices.push_back({part, vertex});
    for (const auto& [a, b] : mesh::kTetEdgeCorners) {
      edges.push_back({part, std::min(v[a], v[b]), std::max(v[a], v[b])});
    }
    for (const auto& face : mesh::kTetFaceCorners) {
      const auto [a, b, c] = mesh::sorted_triangle(v[face[0]], v[face[1]], v[face[2]]);
      triangles.push_back({part, a, b, c});
    }
  }
  std::vector<GlobalIndex> euler(static_cast<std::size_t>(num_parts), 0);
  count_rows(std::move(vertices), 1, euler);
  count_rows(std::move(edges), -1, euler);
  count_rows(std::move(triangles), 1, euler);
  for (const LocalIndex part : tet_part) --euler[static_cast<std::size_t>(part)];
  return euler;
}

}  // namespace tessera::verify
