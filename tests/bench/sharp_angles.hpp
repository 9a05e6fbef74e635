// SPDX-License-Identifier: BSD-3-Clause
// The smallest angles that a CAD model has by itself, for the bench corpus: no mesh of it can do
// better there, so a small angle of a mesh counts only beside them.
#pragma once

#include <Poly_Triangulation.hxx>
#include <TopoDS_Shape.hxx>

/// @brief In degrees; 360 where there is none.
struct SharpAngles {
  double of_faces = 360.0;  ///< Between two faces at an edge, through the solid.
  double of_edges = 360.0;  ///< Between two edges at a vertex, through their face.
};

/// @brief Local. An estimate: faces are compared at seven places of each edge.
SharpAngles sharp_angles(const TopoDS_Shape& solid);

/// @brief Local. Between triangles alone; their corners may be joined or not.
SharpAngles sharp_angles(const Poly_Triangulation& closed_surface);
