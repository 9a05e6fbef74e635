// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "tessera/decompose/graph_partitioner.hpp"

namespace tessera::decompose {

/// @brief partitioner.partition() with the trivial cases answered here and the result checked.
/// @pre 1 <= num_parts <= graph.num_vertices().
/// @throws MeshError if the result has a wrong length or a part out of range.
[[nodiscard]] std::vector<LocalIndex> checked_partition(const GraphPartitioner& partitioner,
                                                        const Graph& graph, LocalIndex num_parts);

}  // namespace tessera::decompose
