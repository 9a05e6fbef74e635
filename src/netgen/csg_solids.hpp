// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include <csg.hpp>

#include "netgen/occ_cad_file.hpp"

namespace tessera::netgen {

/// @brief Describes each cone that the file gives by its apex by two circles of the same surface.
/// From the smaller radius NETGEN takes how much a cone bends at most: with 0 it halves boxes
/// around points of other surfaces until it gives up, however far the apex is. Local.
void describe_cones_by_circles(::netgen::CSGeometry& geometry);

/// @brief Whether the apex of a cone lies on the surface of a solid that is to be meshed. NETGEN's
/// CSG does not know such points: it mostly follows an edge from there for ever. Local.
/// @param[in] tolerance So near to a surface a point is on it, file length unit.
[[nodiscard]] bool has_apex(::netgen::CSGeometry& geometry, double tolerance);

/// @brief The solids to be meshed, made once more with OpenCASCADE, with the names of solids and
/// faces. Of a cone only the side counts that its two circles lie on. Local.
/// @param[in] box All solids lie in it.
/// @throws GeometryError that names what has no counterpart, and if OpenCASCADE fails.
[[nodiscard]] CadFile solids_of_csg(::netgen::CSGeometry& geometry, const ::netgen::Box<3>& box);

/// @brief Box of the solids of a shape. Local.
/// @throws GeometryError unless there are solids, and all of them are within `bound`.
[[nodiscard]] ::netgen::Box<3> box_of_solids(const TopoDS_Shape& shape,
                                             const ::netgen::Box<3>& bound);

}  // namespace tessera::netgen
