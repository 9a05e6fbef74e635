// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "tessera/base/types.hpp"
#include "tessera/mesh/skeleton.hpp"

namespace tessera::mesh {

/// @brief What a fine vertex is counted under: a coarse entity of the skeleton, or the interior of
/// one piece. Units are numbered: skeleton vertices, edges, triangles, then pieces.
using HostEntity = LocalIndex;

/// @brief Numbers of the hosts of a skeleton.
struct HostLayout {
  HostEntity first_edge = 0;
  HostEntity first_triangle = 0;
  HostEntity first_piece = 0;

  explicit HostLayout(const Skeleton& skeleton)
      : first_edge(skeleton.num_vertices()),
        first_triangle(first_edge + skeleton.num_edges()),
        first_piece(first_triangle + skeleton.num_triangles())
  {
  }
};

/// @brief The refined, closed, outward surface of one subdomain.
struct Skin {
  std::vector<double> vertex_xyz{};        ///< Shape (num_vertices, 3).
  std::vector<HostEntity> vertex_host{};   ///< Shape (num_vertices).
  std::vector<LocalIndex> vertex_index{};  ///< Place within its host.
  std::vector<LocalIndex>
      triangle_vertices{};                    ///< Shape (num_triangles, 3); normals point outwards.
  std::vector<LocalIndex> triangle_parent{};  ///< Skeleton triangle of each.

  [[nodiscard]] LocalIndex num_vertices() const
  {
    return static_cast<LocalIndex>(vertex_host.size());
  }
  [[nodiscard]] LocalIndex num_triangles() const
  {
    return static_cast<LocalIndex>(triangle_parent.size());
  }
};

}  // namespace tessera::mesh
