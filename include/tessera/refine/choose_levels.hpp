// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "tessera/base/types.hpp"
#include "tessera/mesh/coarse_mesh.hpp"
#include "tessera/mesh/edge_levels.hpp"

namespace tessera::refine {

/// @brief The edges of the tets of a coarse mesh. Shape (num_edges, 2): each row ascends, and the
/// rows as well. Local; O(n log n).
[[nodiscard]] std::vector<LocalIndex> coarse_edges(const mesh::CoarseMesh& coarse);

/// @brief A level for each coarse edge: the smallest that makes its parts as short as wanted. Then
/// edges are raised until in every tet levels differ by one at most.
///
/// 2^l parts are enough for `num_wanted` if that is 2^l sqrt(2) or less: between half and twice as
/// many the rounding is fair, and the median comes out at the wanted length.
/// @param[in] edges coarse_edges().
/// @param[in] num_wanted Shape (num_edges). How many wanted lengths each edge is long: the integral
/// of ds / h along it.
/// @param[in] most No edge gets more levels.
/// @note Local; a pure function of its arguments, whatever the order of the tets.
[[nodiscard]] mesh::EdgeLevels choose_levels(const mesh::CoarseMesh& coarse,
                                             std::vector<LocalIndex> edges,
                                             const std::vector<double>& num_wanted, int most);

}  // namespace tessera::refine
