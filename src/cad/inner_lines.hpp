// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <TopTools_ListOfShape.hxx>
#include <TopoDS_Shape.hxx>

#include "tessera/base/vec3.hpp"

#include "cad/cut.hpp"

namespace tessera::cad {

/// @brief Edges of a shape that no face has: the lines inside of its solids. Local.
[[nodiscard]] std::vector<TopoDS_Shape> inner_lines_of(const TopoDS_Shape& shape);

/// @brief Whether the middle of an edge lies in a solid or on its surface. Local.
[[nodiscard]] bool lies_in(const TopoDS_Shape& edge, const TopoDS_Shape& solid);

/// @brief The direction that these lines are swept in: the farthest from all of theirs, and one of
/// the axes where that is about as good. Local.
/// @throws NetgenError with the place if every direction is along one of the lines.
[[nodiscard]] Vec3 sweep_of(const std::vector<TopoDS_Shape>& lines);

/// @brief Adds the *curtains* of the lines in a solid: faces that part it and have the lines as
/// edges. Where a line ends it goes on straight to the outside, and all is swept both ways. Local.
/// @param[in] sweep Of length 1, as sweep_of().
void append_curtains(const std::vector<TopoDS_Shape>& lines, const Vec3& sweep,
                     const TopoDS_Shape& solid, TopTools_ListOfShape& tools);

/// @brief Throws NetgenError with the place unless the cells have each of the shape's lines, from
/// end to end, as edges. Local.
void require_lines(const CutShape& cells, const TopoDS_Shape& shape);

}  // namespace tessera::cad
