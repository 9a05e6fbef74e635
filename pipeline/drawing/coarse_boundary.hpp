// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "tessera/base/types.hpp"
#include "tessera/subdomain/partitioned_mesh.hpp"

namespace tessera::pipeline {

/// @brief A triangle of the coarse mesh that bounds what was made, or is on the geometry.
struct CoarseTriangle {
  std::array<LocalIndex, 3> vertices{};  ///< Of the coarse mesh, seen from outside of `subdomain`.
  LocalIndex subdomain = 0;              ///< That was made; of two the one that it looks out of.
  LocalIndex patch = 0;     ///< Row in files; their number where it is not on the geometry.
  bool is_between = false;  ///< Of two subdomains that were made.
};

/// @brief The triangles, those between two subdomains only on the geometry. Local.
/// @param[in] is_made By subdomain.
[[nodiscard]] std::vector<CoarseTriangle> coarse_boundary(const subdomain::PartitionedMesh& cut,
                                                          const std::vector<char>& is_made);

}  // namespace tessera::pipeline
