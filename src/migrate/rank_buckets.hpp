// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <vector>

#include "tessera/base/types.hpp"

namespace tessera::migrate {

/// @brief One `T` for each of the few ranks that are asked for.
template <class T>
class RankBuckets {
 public:
  explicit RankBuckets(int num_ranks) : row_(static_cast<std::size_t>(num_ranks), kNoIndex) {}

  /// @brief The bucket of a rank, new and empty the first time.
  [[nodiscard]] T& operator[](Rank rank)
  {
    LocalIndex& row = row_[at(rank)];
    if (row == kNoIndex) {
      row = static_cast<LocalIndex>(ranks_.size());
      ranks_.push_back(rank);
      buckets_.push_back(std::make_unique<T>());
    }
    return *buckets_[at(row)];
  }

  /// @brief Ranks that were asked for, ascending.
  [[nodiscard]] std::vector<Rank> ranks() const
  {
    std::vector<Rank> sorted = ranks_;
    std::sort(sorted.begin(), sorted.end());
    return sorted;
  }

 private:
  std::vector<LocalIndex> row_;
  std::vector<Rank> ranks_{};
  std::vector<std::unique_ptr<T>> buckets_{};  // References stay valid as it grows.
};

}  // namespace tessera::migrate
