// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

#include "tessera/base/types.hpp"
#include "tessera/base/vec3.hpp"
#include "tessera/mesh/tet_topology.hpp"

namespace tessera::mesh {

/// @brief Longest edge of a tet. Local.
[[nodiscard]] inline double longest_edge(const std::array<Vec3, 4>& corners) noexcept
{
  double longest = 0.0;
  for (const auto& [a, b] : kTetEdgeCorners) {
    longest = std::max(longest, norm(corners[b] - corners[a]));
  }
  return longest;
}

/// @brief Angle of a tet at edge `edge` of kTetEdgeCorners, radians in [0, pi]. Local.
[[nodiscard]] inline double dihedral_angle(const std::array<Vec3, 4>& corners,
                                           std::size_t edge) noexcept
{
  const auto& [a, b] = kTetEdgeCorners[edge];
  const auto& [c, d] = kTetEdgeCorners[5 - edge];  // The edge opposite to it.
  const Vec3 along = corners[b] - corners[a];
  return angle_between(cross(along, corners[c] - corners[a]),
                       cross(along, corners[d] - corners[a]));
}

/// @brief Calls visit(a, b), a < b, once for each different edge of the tets.
///
/// Edges are gathered by their lower vertex and repetitions seen by a mark on the upper one: linear
/// time, 7 words a tet of memory, no sorting of edges. Vertices of a tet are sorted, so that its
/// edges go to three places only.
/// @param[in] tet_vertices Shape (num_tets, 4), each in 0…num_vertices-1, those of a tet all
/// different; at most 2^29 tets. Local.
template <class Visit>
void for_each_edge(std::span<const LocalIndex> tet_vertices, LocalIndex num_vertices, Visit&& visit)
{
  const auto for_each_tet = [&](auto&& see) {
    for (std::size_t t = 0; t < tet_vertices.size(); t += 4) {
      see(sorted_tet(tet_vertices.subspan(t).first<4>()).vertices);
    }
  };
  std::vector<std::uint32_t> end(at(num_vertices) + 1, 0);  // Half the memory of 64 bits.
  for_each_tet([&](const std::array<LocalIndex, 4>& v) {
    for (std::uint32_t c = 0; c < 3; ++c) end[at(v[c]) + 1] += 3 - c;
  });
  std::partial_sum(end.begin(), end.end(), end.begin());
  std::vector<LocalIndex> upper(end.back());
  for_each_tet([&](const std::array<LocalIndex, 4>& v) {
    for (std::size_t c = 0; c < 3; ++c) {
      std::uint32_t& next = end[at(v[c])];
      for (std::size_t high = c + 1; high < 4; ++high) upper[next++] = v[high];
    }
  });

  std::vector<LocalIndex> seen_from(at(num_vertices), kNoIndex);
  std::uint32_t begin = 0;
  for (LocalIndex low = 0; low < num_vertices; ++low) {
    // What is new comes to the front. Without a branch, as none could be foretold.
    std::uint32_t end_of_new = begin;
    for (std::uint32_t i = begin; i < end[at(low)]; ++i) {
      const LocalIndex high = upper[i];
      upper[end_of_new] = high;
      end_of_new += seen_from[at(high)] == low ? 0U : 1U;
      seen_from[at(high)] = low;
    }
    for (std::uint32_t i = begin; i < end_of_new; ++i) visit(low, upper[i]);
    begin = end[at(low)];
  }
}

}  // namespace tessera::mesh
