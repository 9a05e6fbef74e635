// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <csg.hpp>

#include "tessera/surface/coarse_surface.hpp"
#include "tessera/surface/patch_surface.hpp"

#include "netgen/csg/triangles.hpp"

namespace tessera::netgen {

/// @brief A surface that was made of triangles of the solids, in the numbers and names that a mesh
/// of NETGEN's CSG has: patches, curves, materials. Each body is a domain. Local.
/// @param[in] surface  Its patches and curves are those of `triangles`.
/// @param[in] max_size Largest edge in solids for which the file wants no smaller one.
[[nodiscard]] surface::CoarseSurface in_numbers_of_csg(const surface::PatchSurface& surface,
                                                       const CsgTriangles& triangles,
                                                       const ::netgen::CSGeometry& geometry,
                                                       double max_size);

}  // namespace tessera::netgen
