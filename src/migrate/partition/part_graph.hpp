// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <set>
#include <utility>
#include <vector>

#include "tessera/base/index_lists.hpp"
#include "tessera/base/types.hpp"

namespace tessera::migrate {

/// @brief Tets that one part shall give to a neighbour.
struct Transfer {
  LocalIndex from = 0;
  LocalIndex to = 0;
  GlobalIndex num_tets = 0;

  friend bool operator==(const Transfer&, const Transfer&) = default;
};

/// @brief Sizes of all parts and who is beside whom.
struct PartGraph {
  std::vector<GlobalIndex> sizes{};  ///< Shape (num_parts).
  IndexLists neighbours{};           ///< Shape (num_parts, …), ascending.
};

/// @brief Transfers from part to part that can be made at the same time: no part takes part in two.
///
/// For each part that is too large, this is the last step on a shortest way from it to a part below
/// the average. So room comes nearer round by round. Local; a pure function.
/// @param[in] banned Pairs (from, to) that have turned out to be impossible.
[[nodiscard]] std::vector<Transfer> plan_transfers(
    const PartGraph& graph, GlobalIndex largest_allowed,
    const std::set<std::pair<LocalIndex, LocalIndex>>& banned);

}  // namespace tessera::migrate
