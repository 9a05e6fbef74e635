// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "tessera/base/types.hpp"

namespace tessera::mesh {

/// @brief Sorts rows of vertices in linear time but for short runs: first by their smallest vertex,
/// which is dense, then within each run of the same.
/// @param[in] smallest_of Gives the smallest vertex of a row. @param[in] less Total order that
/// agrees with it.
template <class Row, class SmallestOf, class Less>
void sort_by_smallest(std::vector<Row>& rows, SmallestOf smallest_of, Less less)
{
  std::vector<std::size_t> begins(1, 0);
  for (const Row& row : rows) {
    const std::size_t end = at(smallest_of(row)) + 2;
    if (begins.size() < end) begins.resize(end, 0);
    ++begins[end - 1];
  }
  for (std::size_t v = 1; v < begins.size(); ++v) begins[v] += begins[v - 1];
  std::vector<std::size_t> next(begins.begin(), begins.end() - 1);
  std::vector<Row> sorted(rows.size());
  for (const Row& row : rows) sorted[next[at(smallest_of(row))]++] = row;
  const auto place = [&](std::size_t r) { return sorted.begin() + static_cast<std::ptrdiff_t>(r); };
  for (std::size_t v = 0; v + 1 < begins.size(); ++v) {
    std::sort(place(begins[v]), place(begins[v + 1]), less);
  }
  rows = std::move(sorted);
}

/// @brief Different rows in ascending order, and which of them each given row is.
template <std::size_t N>
struct NumberedRows {
  std::vector<std::array<LocalIndex, N>> rows{};
  std::vector<LocalIndex> row_of{};  ///< Shape (number of given rows).
};

/// @brief Finds the different ones of rows of two or three ascending vertices. Linear but for short
/// runs of the same smallest vertex. @param[in] rows In any order, repeated or not; vertices are
/// dense.
template <std::size_t N>
[[nodiscard]] NumberedRows<N> number_rows(const std::vector<std::array<LocalIndex, N>>& rows)
{
  static_assert(N == 2 || N == 3);
  struct Entry {
    std::uint64_t others;  // The vertices but for the smallest, in one word.
    LocalIndex smallest;
    LocalIndex source;
  };
  std::vector<Entry> entries;
  entries.reserve(rows.size());
  for (const auto& row : rows) {
    std::uint64_t others = 0;
    for (std::size_t c = 1; c < N; ++c) others = others << 32U | static_cast<std::uint64_t>(row[c]);
    entries.push_back({others, row[0], static_cast<LocalIndex>(entries.size())});
  }
  sort_by_smallest(
      entries, [](const Entry& entry) { return entry.smallest; },
      [](const Entry& a, const Entry& b) { return a.others < b.others; });

  NumberedRows<N> numbered{.row_of = std::vector<LocalIndex>(rows.size())};
  for (const Entry& entry : entries) {
    const auto& row = rows[at(entry.source)];
    if (numbered.rows.empty() || numbered.rows.back() != row) numbered.rows.push_back(row);
    numbered.row_of[at(entry.source)] = static_cast<LocalIndex>(numbered.rows.size() - 1);
  }
  return numbered;
}

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
