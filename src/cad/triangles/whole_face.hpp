// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <TopoDS_Face.hxx>

namespace tessera::cad {

/// @brief Whether the triangles of a face are bounded by the polygons of its edges, and by nothing
/// else. Nodes at one vertex of the shape count as one. OpenCASCADE leaves triangles out where the
/// boundary of a face touches or cuts itself. Local.
[[nodiscard]] bool has_whole_triangles(const TopoDS_Face& face);

/// @brief Whether the triangles of a face that has them go along with its surface, and none of
/// their edges leads across a bend. OpenCASCADE joins points of a narrow helical strip that way.
/// @param[in] deflection  That was asked for, model length unit. Local.
[[nodiscard]] bool follows_surface(const TopoDS_Face& face, double deflection);

}  // namespace tessera::cad
