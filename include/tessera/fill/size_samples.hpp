// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tessera/fill/kernel.hpp"
#include "tessera/mesh/coarse_mesh.hpp"
#include "tessera/mesh/decomposition.hpp"

namespace tessera::fill {

/// @brief Puts the background size into a fill: at the middle of every coarse tet of the subdomain
/// and of its four corners' connections, the mean length of the tet's edges divided by 2^levels.
///
/// Without it NETGEN grows the tets inside a skin by grading alone, and the result depends on how
/// many skins there are: 11.8 k tets with 1 and 38.1 k with 32 (circle_on_cube, 2 levels).
/// @note Local.
void add_size_samples(const mesh::CoarseMesh& coarse, const mesh::Decomposition& decomposition,
                      LocalIndex subdomain, int levels, FillInput& input);

}  // namespace tessera::fill
