// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <TopTools_MapOfShape.hxx>
#include <TopoDS_Shape.hxx>

#include "tessera/base/types.hpp"

#include "cad/cut.hpp"

namespace tessera::cad {

/// @brief Faces of a solid with the solid on both sides, each once: those that end inside of it.
/// Local.
[[nodiscard]] std::vector<TopoDS_Shape> inner_faces_of(const TopoDS_Shape& solid);

/// @brief Faces with one body on both sides: inner faces, and those that divide a body. Local.
/// @param[in] solid_body By solid of TopExp_Explorer, as in OccContent.
[[nodiscard]] TopTools_MapOfShape faces_inside_of_bodies(const TopoDS_Shape& shape,
                                                         const std::vector<LocalIndex>& solid_body);

/// @brief Whether a solid of the shape has faces or lines inside. Local.
[[nodiscard]] bool has_inner_parts(const TopoDS_Shape& shape);

/// @brief The shape's solids cut into *cells*, of which none has a face or a line inside. Each
/// inner face is continued on its own surface to the sides of its solid, so it lies between two
/// cells; lines are edges of curtains that do. Local.
/// @throws NetgenError if a face cannot be continued or a line not be put in, with its place, and
/// as cut_shape().
[[nodiscard]] CutShape cells_of(const TopoDS_Shape& shape);

}  // namespace tessera::cad
