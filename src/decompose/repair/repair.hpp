// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "decompose/partition/tet_partition.hpp"

namespace tessera::decompose {

struct RepairCounts {
  LocalIndex num_moves = 0;
  LocalIndex num_splits = 0;
};

/// @brief Makes every part's skin one closed manifold surface: moves tets over seams, and splits a
/// part that no move helps. Ends, because moves end and a part of one tet is never split.
/// @pre Parts are face-connected; they stay so.
RepairCounts repair(const TetGraph& graph, TetPartition& partition);

}  // namespace tessera::decompose
