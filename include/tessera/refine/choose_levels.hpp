// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "tessera/base/types.hpp"
#include "tessera/mesh/coarse_mesh.hpp"
#include "tessera/mesh/edge_levels.hpp"

namespace tessera::refine {

/// @brief A level for each coarse edge: the smallest that makes its parts as short as wanted. Then
/// edges are raised until three rules hold. In every tet levels differ by one at most. No triangle
/// on the geometry has two sides that are finer than the third. Images of each other have one
/// level.
///
/// 2^l parts are enough for `num_wanted` if that is 1.4 * 2^l or less. Between 1.2 and sqrt(2) the
/// number of tets at equal size is the same.
/// @param[in] edges mesh::coarse_edges().
/// @param[in] num_wanted Shape (num_edges). How many wanted lengths each edge is long: the integral
/// of ds / h along it.
/// @param[in] most No edge gets more levels.
/// @note Local; a pure function of its arguments, whatever the order of the tets.
[[nodiscard]] mesh::EdgeLevels choose_levels(const mesh::CoarseMesh& coarse,
                                             std::vector<LocalIndex> edges,
                                             const std::vector<double>& num_wanted, int most);

}  // namespace tessera::refine
