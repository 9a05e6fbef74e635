// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <TopoDS_Shape.hxx>

#include "tessera/surface/patch_surface.hpp"

namespace tessera::cad {

/// @brief OpenCASCADE's triangles of a shape as one closed surface.
///
/// Patches and curves have the numbers of faces and edges (parts_of()). Materials have those of the
/// solids in TopExp_Explorer's order. Vertices of the shape are fixed.
/// @param[in] size  Edge length that the triangles shall be good enough for, file length unit.
/// @throws NetgenError if a face cannot be triangulated or the triangles leave a gap.
[[nodiscard]] surface::PatchSurface tessellation_of(const TopoDS_Shape& shape, double size);

}  // namespace tessera::cad
