// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tessera/mesh/coarse_mesh.hpp"
#include "tessera/model/model.hpp"

namespace tessera::coarse {

/// @brief Moves vertices off the geometry out of the way of arcs, in place. Local.
///
/// Refinement puts the edges on the geometry onto it, and beside a hole they bow into their tets.
/// The children at the end of such an edge follow its tangent, the closer the more levels there
/// are. So a positive tet may have children that are not, on a fine level only. Each tet is taken
/// as one of second order here, with the middles of its edges on the geometry. Where its least
/// scaled Jacobian at a corner is not positive, its vertices off the geometry go where the worst
/// tet around them is best. Tets without such a vertex, and those whose triangle folds itself, are
/// left as they are.
/// @return How many moves were made (Repair::room_for_arcs).
/// @pre mesh::validate() accepts the mesh.
/// @cite knupp2001  Scaled Jacobian.
LocalIndex make_room_for_arcs(mesh::CoarseMesh& mesh, const model::Model& model);

}  // namespace tessera::coarse
