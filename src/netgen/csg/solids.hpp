// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include <csg.hpp>

#include "cad/cad_file.hpp"

namespace tessera::netgen {

/// @brief Describes each cone that the file gives by its apex by two circles of the same surface.
/// From the smaller radius NETGEN takes how much a cone bends at most: with 0 it halves boxes
/// around points of other surfaces until it gives up, however far the apex is. Local.
void describe_cones_by_circles(::netgen::CSGeometry& geometry);

/// @brief Whether the apex of a cone lies on the surface of a solid that is to be meshed. NETGEN's
/// CSG does not know such points: it mostly follows an edge from there for ever. Local.
/// @param[in] tolerance So near to a surface a point is on it, file length unit.
[[nodiscard]] bool has_apex(::netgen::CSGeometry& geometry, double tolerance);

/// @brief Solids of a CSG model, made by OpenCASCADE.
struct CsgSolids {
  cad::CadFile cad{};        ///< With the names of solids and faces.
  std::vector<int> empty{};  ///< NETGEN's numbers of those that hold nothing, ascending.
};

/// @brief The solids to be meshed, made once more with OpenCASCADE. Of a cone only the side counts
/// that its two circles lie on. Local.
/// @param[in] box All solids lie in it.
/// @throws GeometryError that names what has no counterpart, and if OpenCASCADE fails.
[[nodiscard]] CsgSolids solids_of_csg(::netgen::CSGeometry& geometry, const ::netgen::Box<3>& box);

/// @brief Why OpenCASCADE cannot make a mesh of the file: it has no counterpart of a body, or the
/// file says of faces, edges and points what NETGEN's mesher alone goes by. Empty: it can. Local.
[[nodiscard]] std::string why_only_netgen(::netgen::CSGeometry& geometry);

/// @brief Those solids to be meshed that NETGEN's search finds no point of: they hold nothing, or
/// are too small for it. Local.
/// @pre CalcTriangleApproximation() was called. @returns NETGEN's numbers, ascending.
[[nodiscard]] std::vector<int> unseen_solids(::netgen::CSGeometry& geometry);

/// @brief Box of the solids of a shape. Local.
/// @throws GeometryError unless there are solids, and all of them are within `bound`.
[[nodiscard]] ::netgen::Box<3> box_of_solids(const TopoDS_Shape& shape,
                                             const ::netgen::Box<3>& bound);

}  // namespace tessera::netgen
