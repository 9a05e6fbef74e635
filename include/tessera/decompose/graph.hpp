// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "tessera/base/types.hpp"
#include "tessera/base/vec3.hpp"

namespace tessera::decompose {

/// @brief Undirected graph with integer weights in CSR form: each edge stands once at either end.
///
/// Weights are positive; the sum over all vertices, and over all edge entries, is below 2^31.
struct Graph {
  std::vector<LocalIndex> offsets{0};         ///< Shape (num_vertices + 1).
  std::vector<LocalIndex> neighbours{};       ///< Shape (num_entries).
  std::vector<std::int32_t> vertex_weight{};  ///< Shape (num_vertices).
  std::vector<std::int32_t> edge_weight{};    ///< Shape (num_entries); price of cutting the edge.
  std::vector<Vec3> place{};  ///< Shape (num_vertices), finite; only some partitioners need it.

  [[nodiscard]] LocalIndex num_vertices() const
  {
    return static_cast<LocalIndex>(offsets.size()) - 1;
  }
};

}  // namespace tessera::decompose
