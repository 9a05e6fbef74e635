// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <csg.hpp>

#include "tessera/coarse/fit_to_cad.hpp"
#include "tessera/surface/patch_surface.hpp"

namespace tessera::netgen {

/// @brief OpenCASCADE's triangles of the solids of a CSG file, divided as the file divides them.
struct CsgTriangles {
  coarse::CadSurface cad{};               ///< Materials of its triangles are bodies, from 1.
  std::vector<LocalIndex> body_object{};  ///< NETGEN's top-level object of each body, from 0.
};

/// @brief Tells of which surfaces and solids of the file the triangles are. Local.
///
/// OpenCASCADE divides its faces where the file knows no edge: at the seam of a cylinder, at the
/// poles of a sphere, between faces of one plane. These edges are no curves here, and their ends
/// are free.
///
/// Which surface a face lies on is told by its triangles, which solid a body is by NETGEN's own
/// test of points on both sides of them. So triangles of anything else are noticed.
/// @param[in] surface Its materials are bodies, from 1.
/// @param[in] box All solids fill it.
/// @throws NetgenError if the triangles are not those of the file's solids.
[[nodiscard]] CsgTriangles triangles_of_csg(surface::PatchSurface surface,
                                            const ::netgen::CSGeometry& geometry,
                                            const ::netgen::Box<3>& box);

}  // namespace tessera::netgen
