// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <TopoDS_Shape.hxx>

#include "cad/cad_file.hpp"

namespace tessera::cad {

/// @brief The closed solid with one edge where pieces of its edges lie on each other. Modellers
/// leave such edges where bodies with a common plane were united or subtracted: a face comes to its
/// own hole, or is two that a strip of no width joins. They are valid for OpenCASCADE, but a mesher
/// takes the gap of zero for detail. Names follow, and `cad.repairs` gets a line.
/// @return The solid itself if it has no such edges, or if a valid one of its volume without them
/// could not be made.
[[nodiscard]] TopoDS_Shape without_overlaps(const TopoDS_Shape& solid, CadFile& cad);

}  // namespace tessera::cad
