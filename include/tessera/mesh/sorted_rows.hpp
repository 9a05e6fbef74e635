// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

#include "tessera/base/types.hpp"

namespace tessera::mesh {

/// @brief Row of a flat array that holds these values; kNoIndex: none does. O(log n).
/// @param[in] flat Shape (num_rows, N); the rows ascend.
template <std::size_t N>
[[nodiscard]] LocalIndex find_row(std::span<const LocalIndex> flat,
                                  const std::array<LocalIndex, N>& values)
{
  const auto row = [&](std::size_t r) { return flat.begin() + static_cast<std::ptrdiff_t>(N * r); };
  std::size_t low = 0;
  std::size_t high = flat.size() / N;
  while (low < high) {
    const std::size_t middle = (low + high) / 2;
    if (std::lexicographical_compare(row(middle), row(middle + 1), values.begin(), values.end())) {
      low = middle + 1;
    } else {
      high = middle;
    }
  }
  const bool is_found = low < flat.size() / N && std::equal(values.begin(), values.end(), row(low));
  return is_found ? static_cast<LocalIndex>(low) : kNoIndex;
}

/// @brief Row of the edge between two vertices, in any order. @param[in] edges Shape (num_edges,
/// 2); each row ascends, and the rows as well.
[[nodiscard]] inline LocalIndex find_edge_row(std::span<const LocalIndex> edges, LocalIndex a,
                                              LocalIndex b)
{
  return find_row<2>(edges, {std::min(a, b), std::max(a, b)});
}

}  // namespace tessera::mesh
