// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <deque>
#include <span>
#include <vector>

#include "decompose/partition/tet_partition.hpp"
#include "decompose/repair/non_manifold_vertices.hpp"

namespace tessera::decompose {

/// @brief Moves single tets over seams while (number of non_manifold, price of the seams) falls
/// lexicographically. Both are integers, so it ends. Parts stay face-connected and not empty.
class SeamMover {
 public:
  SeamMover(const TetGraph& graph, TetPartition& partition, NonManifoldVertices& non_manifold);

  /// @brief Tries these tets, and those around each accepted move, until no move is accepted.
  /// @return Number of moves.
  LocalIndex run(std::span<const LocalIndex> tets);

 private:
  struct Change {
    LocalIndex to = kNoIndex;
    int non_manifold = 0;
    std::int64_t price = 0;
  };
  [[nodiscard]] bool try_move(LocalIndex t);
  [[nodiscard]] Change best_change(LocalIndex t);
  [[nodiscard]] int non_manifold_change(LocalIndex t, LocalIndex to);
  [[nodiscard]] bool keeps_balance(LocalIndex t, LocalIndex to) const;
  [[nodiscard]] bool keeps_connected(LocalIndex t);
  [[nodiscard]] bool is_near_non_manifold(LocalIndex t) const;
  void push(LocalIndex t);

  const TetGraph* graph_;
  TetPartition* partition_;
  NonManifoldVertices* non_manifold_;
  std::deque<LocalIndex> queue_{};
  std::vector<bool> is_queued_;
  std::vector<LocalIndex> visit_;  // shape (num_tets): number of the last search that came here
  LocalIndex num_searches_ = 0;
  std::vector<LocalIndex> stack_{};
  double mean_weight_ = 0.0;
};

}  // namespace tessera::decompose
