// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "decompose/labelling.hpp"

namespace tessera::decompose {

struct RepairCounts {
  LocalIndex num_moves = 0;
  LocalIndex num_splits = 0;
};

/// @brief Makes every label's skin one closed manifold surface: moves tets over seams, and splits a
/// label that no move helps. Ends, because moves end and a label of one tet is never split.
/// @pre Labels are face-connected; they stay so.
RepairCounts repair(const TetGraph& graph, Labelling& labelling);

}  // namespace tessera::decompose
