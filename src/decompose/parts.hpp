// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "tessera/decompose/graph_partitioner.hpp"

namespace tessera::decompose {

/// @brief Part of each vertex of a graph: parts of about the same weight with cheap cuts, connected
/// where the graph allows.
///
/// What the partitioner gives is mended. If a part has several components, all but the heaviest go
/// to the neighbour with which they share most. Then parts that are too heavy give vertices away to
/// lighter neighbours, one by one. A vertex goes only if that makes the parts more alike and leaves
/// both connected.
/// @note Local; the same bits for the same arguments.
/// @pre 1 <= num_parts <= graph.num_vertices().
/// @throws MeshError if the partitioner gives up.
[[nodiscard]] std::vector<LocalIndex> balanced_parts(const Graph& graph, LocalIndex num_parts,
                                                     const GraphPartitioner& partitioner);

}  // namespace tessera::decompose
