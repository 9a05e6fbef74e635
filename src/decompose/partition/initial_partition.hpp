// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "tessera/decompose/graph_partitioner.hpp"

#include "decompose/partition/tet_partition.hpp"

namespace tessera::decompose {

/// @brief The face-connected pieces of each material, and of each part if there are parts, by
/// lowest tet; each ascending.
/// @param[in] tet_part Shape (num_tets), >= 0, or empty.
[[nodiscard]] std::vector<std::vector<LocalIndex>> connected_pieces(
    const TetGraph& graph, std::span<const LocalIndex> tet_part = {});

/// @brief Parts for each piece: at least one, at most its tets, else in proportion to its weight.
/// @pre pieces.size() <= num_parts <= number of tets.
[[nodiscard]] std::vector<LocalIndex> allot_parts(
    const TetGraph& graph, const std::vector<std::vector<LocalIndex>>& pieces,
    LocalIndex num_parts);

/// @brief Face-connected parts, `num_parts` or more. The partitioner cuts each piece; small bits
/// that are left over of a part go to a neighbour. While there are too few parts, the heaviest are
/// halved.
[[nodiscard]] TetPartition partition_pieces(const TetGraph& graph,
                                            const std::vector<std::vector<LocalIndex>>& pieces,
                                            LocalIndex num_parts,
                                            const GraphPartitioner& partitioner);

}  // namespace tessera::decompose
