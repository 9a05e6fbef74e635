// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "decompose/partition/tet_partition.hpp"

namespace tessera::decompose {

/// @brief Gives light parts, left by splits, whole to a neighbour where its skin stays one closed
/// manifold surface, while there are more parts than wanted. Returns the number of merges.
/// @pre All parts keep the promises of decompose(); they still do afterwards.
LocalIndex merge_small(const TetGraph& graph, TetPartition& partition, LocalIndex num_wanted);

}  // namespace tessera::decompose
