// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <csg.hpp>

namespace tessera::netgen {

/// @brief Describes planes by other points of them where the one that the file gives lies on
/// another surface: NETGEN takes the two for one surface then, whatever their shapes and normals.
/// Planes whose points lie on no other surface stay as they are, bit for bit. Local.
/// @param[in] tolerance NETGEN's, by which it tells which surfaces are one; file length unit.
void separate_planes(::netgen::CSGeometry& geometry, double tolerance);

}  // namespace tessera::netgen
