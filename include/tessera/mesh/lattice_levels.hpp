// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "tessera/base/types.hpp"
#include "tessera/mesh/complex.hpp"
#include "tessera/mesh/edge_levels.hpp"
#include "tessera/mesh/lattice.hpp"
#include "tessera/mesh/skeleton.hpp"

namespace tessera::mesh {

/// @brief Levels of the lattices on the edges and triangles of a complex or of the skeleton. A
/// triangle has none more than its sides.
struct LatticeLevels {
  std::vector<std::int8_t> edges{};      ///< Shape (num_edges).
  std::vector<std::int8_t> triangles{};  ///< Shape (num_triangles).

  [[nodiscard]] int edge(LocalIndex e) const { return edges[at(e)]; }
  [[nodiscard]] int triangle(LocalIndex t) const { return triangles[at(t)]; }

  /// @brief Intervals of an edge, and of the sides of a triangle's lattice.
  [[nodiscard]] LocalIndex edge_intervals(LocalIndex e) const
  {
    return lattice::intervals(edge(e));
  }
  [[nodiscard]] LocalIndex triangle_intervals(LocalIndex t) const
  {
    return lattice::intervals(triangle(t));
  }

  /// @brief The largest of all; 0 if there are no edges.
  [[nodiscard]] int largest() const;
};

/// @brief What the levels of the coarse edges make of a complex, or of the skeleton. Local.
[[nodiscard]] LatticeLevels lattice_levels(const Complex& complex, const EdgeLevels& levels);
[[nodiscard]] LatticeLevels lattice_levels(const Skeleton& skeleton, const EdgeLevels& levels);

/// @brief Fine vertices on the skeleton: a closed form. Local.
[[nodiscard]] GlobalIndex num_skeleton_points(const Skeleton& skeleton,
                                              const LatticeLevels& levels);

/// @brief Small triangles that a triangle of a skeleton has: n^2 with n intervals, and n more for
/// each side that is one level finer. A closed form.
[[nodiscard]] GlobalIndex num_small_triangles(const Skeleton& skeleton, const LatticeLevels& levels,
                                              LocalIndex triangle);

}  // namespace tessera::mesh
