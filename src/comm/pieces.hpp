// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <span>
#include <stdexcept>

namespace tessera::comm {

/// @brief `count` as MPI wants it. @throws std::length_error if it does not fit: a message that had
/// to be split.
[[nodiscard]] inline int to_mpi_count(std::size_t count)
{
  if (count > static_cast<std::size_t>(std::numeric_limits<int>::max()))
    throw std::length_error("more than 2^31 elements in one MPI call");
  return static_cast<int>(count);
}

/// @brief Calls `use(pointer, int count)` for one piece of at most `max_count` values after the
/// other. Sender and receiver must use the same `max_count`, then their pieces match.
template <class Value, class Use>
void for_each_piece(std::span<Value> values, std::size_t max_count, const Use& use)
{
  while (!values.empty()) {
    const std::size_t count = std::min(values.size(), max_count);
    use(values.data(), to_mpi_count(count));
    values = values.subspan(count);
  }
}

}  // namespace tessera::comm
