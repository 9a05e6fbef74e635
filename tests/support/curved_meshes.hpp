// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tessera/mesh/coarse_mesh.hpp"
#include "tessera/mesh/decomposition.hpp"

namespace tessera::testing {

/// @brief kuhn_cube(n) blown up to the unit ball around the origin: tets in the same order, every
/// layer of the cube a sphere. One patch on surface 0, no curves, no parameters.
[[nodiscard]] mesh::CoarseMesh ball(int n);

/// @brief The cells of ball(4) between the spheres of radius 1 (surface 0) and 1/2 (surface 1):
/// 336 tets around a cavity.
[[nodiscard]] mesh::CoarseMesh shell();

/// @brief kuhn_cube(n) with its layers blown up to discs: surfaces, curves and parameters are those
/// of CylinderModel. Angles of a triangle and of a segment are of one branch; at the seam at angle
/// 0 the branches of neighbours differ by a turn.
[[nodiscard]] mesh::CoarseMesh cylinder(int n);

/// @brief Decomposition into subdomains of the sign of y of the tets' middles: 0 below, 1 above.
/// One material; without the graph.
[[nodiscard]] mesh::Decomposition halves(const mesh::CoarseMesh& coarse);

}  // namespace tessera::testing
