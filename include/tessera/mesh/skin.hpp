// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "tessera/base/types.hpp"
#include "tessera/mesh/host_layout.hpp"

namespace tessera::mesh {

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
