// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <csg.hpp>

#include "tessera/coarse/coarse_surface.hpp"

namespace tessera::netgen {

/// @brief A surface mesh of the solids that solids_of_csg() made, in the numbers and names that a
/// mesh of NETGEN's CSG has: patches, curves, materials. Parameters go. Local.
///
/// Which surface a patch lies on is told by its triangles, which solid a domain is by NETGEN's own
/// test of points on both sides of them. So a mesh of anything else is noticed.
/// @param[in] box All solids fill it.
/// @throws NetgenError if the mesh is not one of these solids.
[[nodiscard]] coarse::CoarseSurface in_numbers_of_csg(coarse::CoarseSurface surface,
                                                      const ::netgen::CSGeometry& geometry,
                                                      const ::netgen::Box<3>& box);

}  // namespace tessera::netgen
