// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "tessera/mesh/coarse_mesh.hpp"
#include "tessera/mesh/size_points.hpp"
#include "tessera/sizing/size_field.hpp"

namespace tessera::sizing {

/// @brief Where a coarse mesh should be finer, so that no edge of it needs many more levels than
/// others: each gives parts of the wanted size after `factor` parts.
///
/// Tets are cut into eight in bulk rounds until none is longer than its edges may become. A size
/// that grows with the distance cannot fall faster either, so a region inside of a tet is found by
/// the size at its middle.
/// @param[in] factor Length of a coarse edge in wanted ones, > 0.
/// @return Points in tets that are too long, each with the length wanted of coarse edges there.
/// Local; a pure function of its arguments.
[[nodiscard]] mesh::SizePoints coarse_size_points(const mesh::CoarseMesh& coarse,
                                                  const SizeField& sizes, double factor);

/// @brief For each edge of a coarse mesh, its length in radii of curvature of the surface beside
/// it; 0 off the surface, and where that is flat. Local; O(n log n).
///
/// The surface turns by the angle between two triangles of one patch over two fifths of their
/// heights on the common edge. So the radius of a cylinder comes out a fifth too small, that of a
/// sphere a fifth too large.
/// @param[in] edge_vertices refine::coarse_edges(). @return Shape (num_edges).
[[nodiscard]] std::vector<double> lengths_in_radii(const mesh::CoarseMesh& coarse,
                                                   std::span<const LocalIndex> edge_vertices);

}  // namespace tessera::sizing
