// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "tessera/base/types.hpp"

#include "delaunay/lattice_stars.hpp"
#include "delaunay/triangulation.hpp"

namespace tessera::delaunay {

// The Delaunay tets of all points: those of stars, and those of the points that are not closed, but
// for where the stars are. The faces between both are faces of both, since the spheres that make
// them hold no point at all. So tets of the others on the inner side of such a face, and all that
// hang together with them, lie where the stars are.
// @param[in] order Shape (num_vertices): the row of each vertex of the triangulation.
// @return Shape (num_tets, 4): rows; positive.
[[nodiscard]] std::vector<LocalIndex> join_stars(const Triangulation& triangulation,
                                                 std::span<const LocalIndex> order,
                                                 const LatticeStars& stars);

}  // namespace tessera::delaunay
