// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "tessera/base/types.hpp"
#include "tessera/decompose/graph.hpp"

namespace tessera::decompose {

/// @brief Cuts a graph into parts of similar weight with cheap cuts.
class GraphPartitioner {
 public:
  virtual ~GraphPartitioner() = default;

  /// @brief Part of each vertex, in [0, num_parts). Parts may be empty or disconnected: callers
  /// check. A pure function of its arguments.
  /// @note Local.
  /// @pre 2 <= num_parts <= graph.num_vertices().
  /// @throws MeshError if the partitioner gives up.
  [[nodiscard]] virtual std::vector<LocalIndex> partition(const Graph& graph,
                                                          LocalIndex num_parts) const = 0;

  /// @brief Whether it asks for Graph::place.
  [[nodiscard]] virtual bool needs_places() const { return false; }
};

/// @brief METIS with a fixed seed. @cite karypis1998
[[nodiscard]] std::unique_ptr<GraphPartitioner> make_metis_partitioner();

/// @brief Runs of octants along a Hilbert curve: each part is what lies in consecutive leaves of an
/// octree that is divided until a leaf weighs little. Knows no edges, needs Graph::place. O(n log
/// n).
[[nodiscard]] std::unique_ptr<GraphPartitioner> make_octree_partitioner();

/// @brief METIS's version, e.g. "5.1.0".
[[nodiscard]] std::string metis_version();

/// @brief Consecutive blocks of a breadth-first order; needs no library, cuts badly. For tests.
[[nodiscard]] std::unique_ptr<GraphPartitioner> make_block_partitioner();

}  // namespace tessera::decompose
