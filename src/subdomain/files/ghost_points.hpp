// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "tessera/base/types.hpp"
#include "tessera/migrate/ghosts.hpp"

namespace tessera::subdomain {

/// @brief Points of a part, to which those of ghosts are added.
struct PartPoints {
  std::vector<GlobalIndex>& ids;    ///< Shape (num_points); ascending until there are ghosts.
  std::vector<double>& xyz;         ///< Shape (num_points, 3).
  std::vector<LocalIndex>& owners;  ///< Shape (num_points).
};

/// @brief Rows of the ghosts' vertices: of points that are there, or of new ones behind them.
/// Local.
[[nodiscard]] inline std::vector<LocalIndex> add_ghost_points(const migrate::GhostTets& ghosts,
                                                              const PartPoints& points)
{
  const migrate::MeshBlock& block = ghosts.block;
  const auto num_own = static_cast<std::ptrdiff_t>(points.ids.size());
  std::vector<LocalIndex> rows;
  for (LocalIndex v = 0; v < block.num_vertices(); ++v) {
    const auto own_end = points.ids.begin() + num_own;
    const auto own = std::lower_bound(points.ids.begin(), own_end, block.vertex_ids[at(v)]);
    if (own != own_end && *own == block.vertex_ids[at(v)]) {
      rows.push_back(static_cast<LocalIndex>(own - points.ids.begin()));
      continue;
    }
    rows.push_back(static_cast<LocalIndex>(points.ids.size()));
    points.ids.push_back(block.vertex_ids[at(v)]);
    for (const double x : block.position(v)) points.xyz.push_back(x);
    points.owners.push_back(ghosts.vertex_owner[at(v)]);
  }
  return rows;
}

}  // namespace tessera::subdomain
