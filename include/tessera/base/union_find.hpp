// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "tessera/base/types.hpp"

namespace tessera {

/// @brief Disjoint sets of 0…n-1; the lowest member stands for its set.
class UnionFind {
 public:
  explicit UnionFind(LocalIndex n = 0) : parent_(static_cast<std::size_t>(n))
  {
    std::iota(parent_.begin(), parent_.end(), 0);
  }

  [[nodiscard]] LocalIndex find(LocalIndex i)
  {
    while (parent(i) != i) {
      parent(i) = parent(parent(i));
      i = parent(i);
    }
    return i;
  }

  /// @brief Joins the sets of both. @return Whether they were two.
  bool join(LocalIndex a, LocalIndex b)
  {
    a = find(a);
    b = find(b);
    if (a == b) return false;
    if (b < a) std::swap(a, b);
    parent(b) = a;
    return true;
  }

  /// @brief Adds n as a set of its own, and returns it.
  LocalIndex add()
  {
    parent_.push_back(static_cast<LocalIndex>(parent_.size()));
    return parent_.back();
  }

  /// @brief Makes each of these a set of its own again. @pre The sets of all of them are given
  /// whole.
  void separate(std::span<const LocalIndex> members)
  {
    for (const LocalIndex i : members) parent(i) = i;
  }

  /// @brief Forgets all members; the memory is kept.
  void clear() { parent_.clear(); }

 private:
  LocalIndex& parent(LocalIndex i) { return parent_[static_cast<std::size_t>(i)]; }

  std::vector<LocalIndex> parent_;
};

}  // namespace tessera
