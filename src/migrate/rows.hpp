// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "tessera/base/types.hpp"

namespace tessera::migrate {

/// @brief The given rows of an array, in that order.
/// @param[in] values Shape (…, Width). @param[in] rows each in 0…values.size() / Width - 1.
template <std::size_t Width = 1, class T>
[[nodiscard]] std::vector<T> rows_of(const std::vector<T>& values, std::span<const LocalIndex> rows)
{
  std::vector<T> some(Width * rows.size());
  T* to = some.data();
  for (const LocalIndex row : rows) to = std::copy_n(&values[Width * at(row)], Width, to);
  return some;
}

/// @brief Copies row i of `from` to row rows[i] of `to`, both of shape (…, Width).
template <std::size_t Width = 1, class T>
void put_rows(const std::vector<T>& from, std::span<const LocalIndex> rows, std::vector<T>& to)
{
  const T* row = from.data();
  for (std::size_t i = 0; i < rows.size(); ++i, row += Width) {
    std::copy_n(row, Width, &to[Width * at(rows[i])]);
  }
}

}  // namespace tessera::migrate
