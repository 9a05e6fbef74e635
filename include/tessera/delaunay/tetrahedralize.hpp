// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "tessera/base/types.hpp"

namespace tessera::delaunay {

/// @brief Tets that fill the convex hull of some points.
struct Tetrahedralization {
  std::vector<LocalIndex> tet_vertices{};    ///< Shape (num_tets, 4): rows of the points; positive,
                                             ///< VTK's order.
  std::vector<LocalIndex> tet_neighbours{};  ///< Shape (num_tets, 4): what lies across the face
                                             ///< opposite to corner c of tet t; kNoIndex outside,
                                             ///< 4 u + d if it is opposite to corner d of tet u.

  [[nodiscard]] LocalIndex num_tets() const
  {
    return static_cast<LocalIndex>(tet_vertices.size() / 4);
  }
};

/// @brief The Delaunay tets of some points: no point is inside of a sphere through the corners of a
/// tet. Where several such meshes exist, as on a grid, positions decide: insphere_untied().
///
/// So the tets, and the order in which they come, depend on the set of points and on nothing else:
/// not on the order of the rows, nor on what is known of a lattice. All tests are exact, so no tet
/// is flat, and every point inside and on the hull is right, whatever lies on one plane or sphere.
///
/// Points are put in along a space-filling curve, a few of all first: a walk finds where, and the
/// tets whose spheres hold the point make room for it. @cite bowyer1981 @cite watson1981 The hull
/// has tets to a vertex at infinity, so it needs no box around it.
/// @param[in] xyz Shape (num_points, 3). Of points at the same place the first row stands for all;
/// the others are of no tet.
/// @param[in] lattice_side Shape (num_points), or empty: the side of the cells of a body-centred
/// lattice of which the point is a corner or a middle, with corners at multiples of the side; 0 if
/// of none. Tets deep inside of such lattices are written down: a million points of one take 1.9 s,
/// not 7.2 s.
/// @throws MeshError if a coordinate is not finite or beyond what orient3d() is exact for, if all
/// points lie on one plane, or if there would be 2^29 tets or more.
/// @note Local. Random points: about 6 us each.
[[nodiscard]] Tetrahedralization tetrahedralize(std::span<const double> xyz,
                                                std::span<const double> lattice_side = {});

}  // namespace tessera::delaunay
