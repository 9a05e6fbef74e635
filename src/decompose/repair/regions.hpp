// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "decompose/partition/tet_graph.hpp"

namespace tessera::decompose {

/// @brief Breadth-first searches inside a given set of tets. Each costs the size of the set.
class RegionSearch {
 public:
  explicit RegionSearch(const TetGraph& graph);

  /// @brief The face-connected components of `tets`, each in breadth-first order, by first tet.
  [[nodiscard]] std::vector<std::vector<LocalIndex>> components(std::span<const LocalIndex> tets);

  /// @brief All of `tets` that are connected to `start`, in breadth-first order.
  [[nodiscard]] std::vector<LocalIndex> reach(std::span<const LocalIndex> tets, LocalIndex start);

  /// @brief Cuts a face-connected set in two by growing both seeds, the lighter side first, and
  /// returns the second side. Both sides are connected if both seeds are, and not empty.
  /// @pre The seeds are disjoint, not empty and in `tets`.
  [[nodiscard]] std::vector<LocalIndex> cut(std::span<const LocalIndex> tets,
                                            std::span<const LocalIndex> first_seed,
                                            std::span<const LocalIndex> second_seed);

  /// @brief cut() from two tets far from each other. @pre `tets` is connected, two or more.
  [[nodiscard]] std::vector<LocalIndex> halve(std::span<const LocalIndex> tets);

 private:
  enum class Mark : std::int8_t { outside, inside, reached };

  void mark(std::span<const LocalIndex> tets, Mark value);
  void flood(LocalIndex start, std::vector<LocalIndex>& reached);

  const TetGraph* graph_;
  std::vector<Mark> mark_;  // shape (num_tets); all outside between calls
};

}  // namespace tessera::decompose
