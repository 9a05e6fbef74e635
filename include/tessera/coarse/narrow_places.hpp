// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tessera/mesh/coarse_mesh.hpp"
#include "tessera/mesh/size_points.hpp"

namespace tessera::coarse {

/// @brief The meshes before, if this one has been made finer at narrow places already.
struct FinerBefore {
  int num_meshes = 0;
  LocalIndex num_first_tets = 0;  ///< Of the first mesh, which was not.
};

/// @brief Sizes for another coarse mesh, where the model is too narrow for the edges of this one.
/// Local.
///
/// Where tets are sharper than `angle_deg`, though no sharp angle of the model forces it:
/// - In a thin wall a tet between the two sheets has angles of about the thickness over its edges.
///   Edges shall be a few times the thickness; in walls of hardly any thickness a part of the
///   largest size.
/// - In a narrow strip of the surface, between two curves, triangles are needles. Edges along it
///   shall be a few times its width.
/// @param angle_deg As for find_sharp_tets().
/// @param max_size The largest size of this mesh, > 0.
/// @param before Edges may be half as long in walls each time, and a quarter as long in strips. The
/// bound on what the finer mesh has goes by the first one.
/// @return None of either kind if nothing is that narrow, or if the finer mesh would be out of
/// proportion to this one.
[[nodiscard]] mesh::SizePoints sizes_of_narrow_places(const mesh::CoarseMesh& mesh,
                                                      double angle_deg, double max_size,
                                                      const FinerBefore& before = {});

}  // namespace tessera::coarse
