// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>

namespace tessera {

/// @brief How many threads for_each_in_threads() takes in this process: one, unless it was told
/// otherwise. Local.
[[nodiscard]] int num_threads() noexcept;
void set_num_threads(int count) noexcept;

/// @brief Calls `work` for each item from 0 to `count` - 1, in several threads at once. Local.
///
/// Items are begun in their order. What an item makes may depend on nothing that another one
/// changes; then all is the same for any number of threads. The heaviest should come first.
/// @throws What the first of the items that fail throws, after all of them have ended.
void for_each_in_threads(std::size_t count, const std::function<void(std::size_t item)>& work);

/// @brief The same for many small items: chunks of them that do not depend on the number of
/// threads, as work(first, last) for items from `first` to `last` - 1. Local.
void for_each_chunk_in_threads(
    std::size_t count, const std::function<void(std::size_t first, std::size_t last)>& work);

}  // namespace tessera
