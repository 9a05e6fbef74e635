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

/// @brief New number of each subdomain, by recursive bisection of the weighted graph. Of two halves
/// the one nearer to what is already numbered comes first. So every aligned range is a connected,
/// cheaply cut part wherever the partitioner finds one.
struct Numbering {
  std::vector<LocalIndex> number{};        ///< Shape (num_subdomains).
  std::vector<LocalIndex> part_offsets{};  ///< As in mesh::Decomposition.
};

/// @param[in] num_parts Parts that are numbered one after the other; 0: none.
[[nodiscard]] Numbering hierarchical_numbers(const mesh::Decomposition& decomposition,
                                             LocalIndex num_parts,
                                             const GraphPartitioner& partitioner);

/// @brief The used parts as subdomains, numbered hierarchically, part by part.
/// @throws ConfigError if there are fewer subdomains than parts.
[[nodiscard]] mesh::Decomposition number_subdomains(const TetGraph& graph,
                                                    const TetPartition& partition,
                                                    LocalIndex num_parts,
                                                    const GraphPartitioner& partitioner);

}  // namespace tessera::decompose
