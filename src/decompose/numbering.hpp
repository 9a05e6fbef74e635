// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "tessera/decompose/graph_partitioner.hpp"
#include "tessera/mesh/decomposition.hpp"

#include "decompose/labelling.hpp"

namespace tessera::decompose {

/// @brief The decomposition with these subdomains, and its graph from the shared triangles.
/// @param[in] tet_subdomain Shape (num_tets), compact from 0.
[[nodiscard]] mesh::Decomposition make_decomposition(const TetGraph& graph,
                                                     std::vector<LocalIndex> tet_subdomain);

/// @brief New number of each subdomain: recursive bisection of the weighted graph, each time the
/// half nearer to what is already numbered first. So every aligned range is a connected, cheaply
/// cut part wherever the partitioner finds one.
[[nodiscard]] std::vector<LocalIndex> hierarchical_numbers(const mesh::Decomposition& decomposition,
                                                           const GraphPartitioner& partitioner);

/// @brief The used labels as subdomains, numbered hierarchically.
[[nodiscard]] mesh::Decomposition number_subdomains(const TetGraph& graph,
                                                    const Labelling& labelling,
                                                    const GraphPartitioner& partitioner);

}  // namespace tessera::decompose
