// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "tessera/decompose/graph_partitioner.hpp"
#include "tessera/mesh/decomposition.hpp"

#include "decompose/partition/tet_partition.hpp"

namespace tessera::decompose {

/// @brief The decomposition with these subdomains, and its graph from the shared triangles.
/// @param[in] tet_subdomain Shape (num_tets), compact from 0.
[[nodiscard]] mesh::Decomposition make_decomposition(const TetGraph& graph,
                                                     FlatArray<LocalIndex> tet_subdomain);

/// @brief The used parts as subdomains, numbered by recursive bisection: every aligned range of
/// numbers is a connected, cheaply cut part wherever the partitioner finds one.
/// @param[in] num_parts  Parts of the output that are numbered one after the other; 0: none.
/// @throws ConfigError if there are fewer subdomains than parts.
[[nodiscard]] mesh::Decomposition number_subdomains(const TetGraph& graph,
                                                    const TetPartition& partition,
                                                    LocalIndex num_parts,
                                                    const GraphPartitioner& partitioner);

}  // namespace tessera::decompose
