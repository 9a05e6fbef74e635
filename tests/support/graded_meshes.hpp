// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "tessera/mesh/coarse_mesh.hpp"
#include "tessera/mesh/edge_levels.hpp"

namespace tessera::testing {

/// @brief The same mesh with other numbers of its vertices and tets, and with the corners of its
/// tets in other orders; all tets stay positive.
[[nodiscard]] mesh::CoarseMesh shuffled(const mesh::CoarseMesh& coarse, std::uint32_t seed);

/// @brief Any levels from 0 to `most`, `share` of the edges above 0; then raised until those of
/// each tet differ by one at most. @pre 0 < share <= 1.
[[nodiscard]] mesh::EdgeLevels random_levels(const mesh::CoarseMesh& coarse, int most, double share,
                                             std::uint32_t seed);

}  // namespace tessera::testing
