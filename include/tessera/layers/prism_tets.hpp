// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "tessera/base/types.hpp"

namespace tessera::layers {

/// @brief Corners of a prism: a triangle of the one end in ascending order of names, then the
/// points above these. Where a column is of no length the same point stands twice.
using Prism = std::array<LocalIndex, 6>;

/// @brief Brings a corner of a tet to its front. The tet stays positive. Local.
inline void begin_with(LocalIndex corner, std::array<LocalIndex, 4>& tet)
{
  const auto found = std::ranges::find(tet, corner);
  if (found == tet.begin()) return;
  std::swap(tet[0], *found);
  std::swap(tet[found == tet.begin() + 1 ? 2 : 1], tet[found == tet.begin() + 3 ? 2 : 3]);
}

/// @brief Cuts a prism into three tets, fewer where points stand twice. Local.
///
/// The diagonal of each side begins at the corner with the lower name. So the prism on the other
/// side of it has the same one, and needs no message for it. All tets begin with the same corner:
/// three with the lowest name, two with the top of the pyramid that they make. So whoever reads
/// them can put the cell together again.
/// @param[in] is_outward The triangle, seen in ascending order of names, points towards the other
/// one.
/// @param[out] tets Corners are appended, positive if the prism is.
/// @return The number of tets.
inline LocalIndex append_prism_tets(const Prism& prism, bool is_outward,
                                    std::vector<LocalIndex>& tets)
{
  constexpr std::array<std::array<std::size_t, 4>, 3> kStairs{
      {{0, 1, 2, 5}, {0, 1, 5, 4}, {0, 3, 4, 5}}};
  LocalIndex top = prism[0];
  for (std::size_t c = 0; c < 3; ++c)
    if (prism[c] == prism[3 + c]) top = prism[c];
  LocalIndex num_tets = 0;
  for (const auto& stair : kStairs) {
    std::array<LocalIndex, 4> corners{};
    for (std::size_t c = 0; c < 4; ++c) corners[c] = prism[stair[c]];
    std::array<LocalIndex, 4> sorted = corners;
    std::ranges::sort(sorted);
    if (std::ranges::adjacent_find(sorted) != sorted.end()) continue;
    if (!is_outward) std::swap(corners[2], corners[3]);
    begin_with(top, corners);
    tets.insert(tets.end(), corners.begin(), corners.end());
    ++num_tets;
  }
  return num_tets;
}

}  // namespace tessera::layers
