// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "tessera/mesh/coarse_mesh.hpp"
#include "tessera/mesh/projection_limiter.hpp"
#include "tessera/mesh/skeleton.hpp"

namespace tessera::mesh {

/// @brief Adds the same limits for the other sides of what was split: edges and triangles whose
/// vertices are at the same places. So both sides of a crack stay alike. Local; does nothing
/// without splits.
/// @pre Copies of a coarse vertex stand right behind it.
/// @see topology::split_patches()
[[nodiscard]] std::vector<PointLimit> on_all_sides(std::vector<PointLimit> limits,
                                                   const Skeleton& skeleton,
                                                   const CoarseMesh& coarse);

}  // namespace tessera::mesh
