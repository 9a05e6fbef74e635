// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <TopoDS_Face.hxx>

namespace tessera::cad {

/// @brief Whether the triangles that a face has are bounded by the polygons of its edges and by
/// nothing else, where points of one vertex of the shape are one. OpenCASCADE leaves triangles out
/// where the boundary of a face touches or cuts itself. Local.
[[nodiscard]] bool has_whole_triangles(const TopoDS_Face& face);

}  // namespace tessera::cad
