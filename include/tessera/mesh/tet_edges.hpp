// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <numeric>
#include <span>
#include <vector>

#include "tessera/base/types.hpp"
#include "tessera/mesh/tet_topology.hpp"

namespace tessera::mesh {

/// @brief Calls visit(a, b), a < b, once for each different edge of the tets.
///
/// Edges are gathered by their lower vertex and repetitions seen by a mark on the upper one: linear
/// time, 7 words a tet of memory, no sorting.
/// @param[in] tet_vertices Shape (num_tets, 4), each in 0…num_vertices-1. Local.
template <class Visit>
void for_each_edge(std::span<const LocalIndex> tet_vertices, LocalIndex num_vertices, Visit&& visit)
{
  const auto for_each_tet_edge = [&](auto&& see) {
    for (std::size_t t = 0; t < tet_vertices.size(); t += 4) {
      for (const auto& [a, b] : kTetEdgeCorners) {
        see(std::min(tet_vertices[t + a], tet_vertices[t + b]),
            std::max(tet_vertices[t + a], tet_vertices[t + b]));
      }
    }
  };
  std::vector<std::size_t> end(at(num_vertices) + 1, 0);
  for_each_tet_edge([&](LocalIndex low, LocalIndex) { ++end[at(low) + 1]; });
  std::partial_sum(end.begin(), end.end(), end.begin());
  std::vector<LocalIndex> upper(end.back());
  for_each_tet_edge([&](LocalIndex low, LocalIndex high) { upper[end[at(low)]++] = high; });

  std::vector<LocalIndex> seen_from(at(num_vertices), kNoIndex);
  std::size_t next = 0;
  for (LocalIndex low = 0; low < num_vertices; ++low) {
    for (; next < end[at(low)]; ++next) {
      LocalIndex& mark = seen_from[at(upper[next])];
      if (mark == low) continue;
      mark = low;
      visit(low, upper[next]);
    }
  }
}

}  // namespace tessera::mesh
