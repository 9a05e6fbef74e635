// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tessera/mesh/coarse_mesh.hpp"
#include "tessera/mesh/size_points.hpp"

namespace tessera::coarse {

/// @brief Sizes for another coarse mesh, where walls are too thin for the edges of this one. Local.
///
/// A tet between the two sheets of a wall has angles of about the thickness over its edges. Where
/// that is less than `angle_deg`, though no sharp angle of the model forces it, edges shall be a
/// few times the thickness; in walls of hardly any thickness a part of the largest size.
/// @param angle_deg As for find_sharp_tets().
/// @param max_size The largest size of this mesh, > 0.
/// @return None if no wall is that thin, or if the finer mesh would be out of proportion to this
/// one.
[[nodiscard]] mesh::SizePoints sizes_of_thin_walls(const mesh::CoarseMesh& mesh, double angle_deg,
                                                   double max_size);

}  // namespace tessera::coarse
