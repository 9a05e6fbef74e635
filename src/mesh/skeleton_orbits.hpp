// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "tessera/mesh/coarse_mesh.hpp"
#include "tessera/mesh/skeleton.hpp"

namespace tessera::mesh {

/// @brief Orbits of all that lies on sides with images. Local; O(n log n).
/// @param[in] triangle_face Shape (num_triangles): the coarse face of each, or kNoIndex.
[[nodiscard]] Orbits find_orbits(const Skeleton& skeleton, const CoarseMesh& coarse,
                                 std::span<const LocalIndex> triangle_face);

}  // namespace tessera::mesh
