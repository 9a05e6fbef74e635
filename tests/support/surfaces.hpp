// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "tessera/base/types.hpp"

namespace tessera::testing {

/// @brief What a triangle surface is as a topological space.
struct SurfaceTopology {
  LocalIndex num_unmatched_edges = 0;  ///< Directed edges without exactly one opposite one.
  LocalIndex euler = 0;                ///< V - E + F; 2 for a sphere.
  LocalIndex num_used_vertices = 0;
};

/// @brief Looks at triangles, shape (n, 3), by their directed edges.
[[nodiscard]] SurfaceTopology topology_of(const std::vector<LocalIndex>& triangle_vertices);

/// @brief Volume enclosed by a closed, outward surface: a sum of its own, for tests of others.
[[nodiscard]] double volume_inside(std::span<const double> vertex_xyz,
                                   const std::vector<LocalIndex>& triangle_vertices);

}  // namespace tessera::testing
