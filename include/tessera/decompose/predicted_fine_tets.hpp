// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "tessera/mesh/coarse_mesh.hpp"

namespace tessera::decompose {

/// @brief Fine tets to expect in place of each coarse tet: its volume over that of a regular tet
/// with edge h / 2^levels, h being the mean of its six edges. Shape (num_tets), all > 0. Local.
///
/// A kernel that meshes anew at a given size fills volume; it does not care how many coarse tets
/// were there. 8^levels a tet is exact for 8-way subdivision, but counts a flat coarse tet as much
/// as a round one.
/// @pre levels >= 0; all tets positive.
[[nodiscard]] std::vector<double> predicted_fine_tets(const mesh::CoarseMesh& mesh, int levels);

}  // namespace tessera::decompose
