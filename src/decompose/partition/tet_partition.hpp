// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "tessera/base/index_lists.hpp"

#include "decompose/partition/tet_graph.hpp"

namespace tessera::decompose {

/// @brief A decomposition in the making: the part of each tet, and sums by part. Parts may be
/// empty; the final numbering drops those.
class TetPartition {
 public:
  /// @param[in] tet_part Shape (num_tets), in [0, num_parts).
  TetPartition(const TetGraph& graph, std::vector<LocalIndex> tet_part, LocalIndex num_parts);

  [[nodiscard]] LocalIndex of(LocalIndex t) const { return tet_part_[static_cast<std::size_t>(t)]; }
  [[nodiscard]] LocalIndex num_parts() const { return static_cast<LocalIndex>(weight_.size()); }
  [[nodiscard]] LocalIndex num_used() const { return num_used_; }
  [[nodiscard]] double weight(LocalIndex part) const
  {
    return weight_[static_cast<std::size_t>(part)];
  }
  [[nodiscard]] LocalIndex num_tets(LocalIndex part) const
  {
    return num_tets_[static_cast<std::size_t>(part)];
  }
  [[nodiscard]] double mean_weight() const { return total_weight_ / num_used_; }

  /// @brief Shape (num_tets).
  [[nodiscard]] std::span<const LocalIndex> tet_part() const { return tet_part_; }

  /// @brief Gives tet `t` to another part.
  void assign(LocalIndex t, LocalIndex part);
  /// @brief A part that no tet has.
  [[nodiscard]] LocalIndex add_part();

  /// @brief Sets and resets the part of `t` for a what-if question; sums are not touched.
  void pretend(LocalIndex t, LocalIndex part) { tet_part_[static_cast<std::size_t>(t)] = part; }

 private:
  const TetGraph* graph_;
  std::vector<LocalIndex> tet_part_;
  std::vector<double> weight_;
  std::vector<LocalIndex> num_tets_;
  double total_weight_ = 0.0;
  LocalIndex num_used_ = 0;
};

/// @brief The tets of every part, ascending.
[[nodiscard]] IndexLists tets_of_parts(const TetPartition& partition);

}  // namespace tessera::decompose
