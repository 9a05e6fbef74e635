// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tessera/cut/cut_mesh.hpp"
#include "tessera/model/model.hpp"

namespace tessera::coarse {

/// @brief Makes room for the arcs that edges become, in place. Local.
///
/// Refinement puts the edges on the geometry onto it, and beside a hole they bow into their tets.
/// The children at the end of such an edge follow its tangent, the closer the more levels there
/// are. So a positive tet may have children that are not, on a fine level only. Each tet is taken
/// as one of second order here, with the middles of its edges on the geometry. Where its least
/// scaled Jacobian at a corner is below 0.05, its vertices off the geometry go where the worst
/// tet around them is best. If it folds still, a new vertex takes its place and that of tets
/// around. A tet whose triangle folds itself is left as it is.
/// @param[in,out] filled New tets come last, and are of the part of the tets that they replace.
/// @return How many moves and new vertices there were (Repair::room_for_arcs).
/// @pre mesh::validate() accepts the mesh.
/// @cite knupp2001  Scaled Jacobian.
LocalIndex make_room_for_arcs(cut::CutMesh& filled, const model::Model& model);

}  // namespace tessera::coarse
