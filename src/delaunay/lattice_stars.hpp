// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "tessera/base/types.hpp"
#include "tessera/base/vec3.hpp"

namespace tessera::delaunay {

// Delaunay tets that are known without a search. Deep in a body-centred lattice the tets at a point
// are always the same 24, whatever else there is: their spheres hold nothing, and have no fifth
// point on them.
struct LatticeStars {
  std::vector<LocalIndex> tet_vertices{};  // Shape (num_tets, 4): rows of the points; positive.
  std::vector<char> is_closed{};           // Shape (num_points): whether all tets at it are there.
};

// @param[in] points No two are the same.
// @param[in] lattice_side Shape (num_points): the side of the cells of the lattice of which the
// point is a corner or a middle, 0 if of none. Corners are multiples of the side, exactly. A point
// of which that is not true, or whose neighbours are missing, is not closed.
// @note Local; O(n log n) for each of the sides.
[[nodiscard]] LatticeStars lattice_stars(std::span<const Vec3> points,
                                         std::span<const double> lattice_side);

}  // namespace tessera::delaunay
