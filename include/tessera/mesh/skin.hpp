// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "tessera/base/types.hpp"
#include "tessera/mesh/skeleton.hpp"

namespace tessera::mesh {

/// @brief What a fine vertex is counted under: a coarse entity of the skeleton, or the interior of
/// one piece. Units are numbered: skeleton vertices, edges, triangles, then pieces.
using Unit = LocalIndex;

/// @brief Numbers of the units of a skeleton.
struct UnitLayout {
  Unit first_edge = 0;
  Unit first_triangle = 0;
  Unit first_piece = 0;

  explicit UnitLayout(const Skeleton& skeleton)
      : first_edge(skeleton.num_vertices()),
        first_triangle(first_edge + skeleton.num_edges()),
        first_piece(first_triangle + skeleton.num_triangles())
  {
  }
};

/// @brief The refined, closed, outward surface of one subdomain.
struct Skin {
  std::vector<double> vertex_xyz{};        ///< Shape (num_vertices, 3).
  std::vector<Unit> vertex_unit{};         ///< Shape (num_vertices).
  std::vector<LocalIndex> vertex_index{};  ///< Place within its unit.
  std::vector<LocalIndex>
      triangle_vertices{};                    ///< Shape (num_triangles, 3); normals point outwards.
  std::vector<LocalIndex> triangle_parent{};  ///< Skeleton triangle of each.

  [[nodiscard]] LocalIndex num_vertices() const
  {
    return static_cast<LocalIndex>(vertex_unit.size());
  }
  [[nodiscard]] LocalIndex num_triangles() const
  {
    return static_cast<LocalIndex>(triangle_parent.size());
  }
};

}  // namespace tessera::mesh
