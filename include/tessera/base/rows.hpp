// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "tessera/base/types.hpp"

namespace tessera {

/// @brief The given rows of an array, in that order. Local.
/// @param[in] values Shape (…, Width). @param[in] rows each in 0…values.size() / Width - 1.
template <std::size_t Width = 1, class Values>
[[nodiscard]] Values rows_of(const Values& values, std::span<const LocalIndex> rows)
{
  Values some(Width * rows.size());
  auto* to = some.data();
  for (const LocalIndex row : rows) to = std::copy_n(&values[Width * at(row)], Width, to);
  return some;
}

/// @brief Copies row i of `from` to row rows[i] of `to`, both of shape (…, Width). Local.
template <std::size_t Width = 1, class T>
void put_rows(const std::vector<T>& from, std::span<const LocalIndex> rows, std::vector<T>& to)
{
  const T* row = from.data();
  for (std::size_t i = 0; i < rows.size(); ++i, row += Width) {
    std::copy_n(row, Width, &to[Width * at(rows[i])]);
  }
}

/// @brief At which place of an order each row is. Local.
/// @param[in] order Each of 0…order.size() - 1 once.
[[nodiscard]] inline std::vector<LocalIndex> inverse_of(std::span<const LocalIndex> order)
{
  std::vector<LocalIndex> place(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) place[at(order[i])] = static_cast<LocalIndex>(i);
  return place;
}

}  // namespace tessera
