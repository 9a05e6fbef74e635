// SPDX-License-Identifier: BSD-3-Clause
// The smallest angles that a CAD model has by itself, for the bench corpus: no mesh of it can do
// better there, so a small angle of a mesh counts only beside them.
#pragma once

#include <Poly_Triangulation.hxx>
#include <TopTools_ListOfShape.hxx>
#include <TopoDS_Shape.hxx>

/// @brief In degrees; 360 where there is none.
struct SharpAngles {
  double of_faces = 360.0;  ///< Between two faces at an edge, through the solid.
  double of_edges = 360.0;  ///< Between two edges at a vertex, through their face.
};

/// @brief Local. An estimate: faces are compared at seven places of each edge.
SharpAngles sharp_angles(const TopoDS_Shape& solid);

/// @brief Local. As they are meshed: solids that touch share faces. Where one's edges end on the
/// other's faces, these get corners that neither has by itself. No angles if they cannot be glued.
SharpAngles sharp_angles_of_glued(const TopTools_ListOfShape& solids);

/// @brief Local. Of joined triangles; edges are where they meet at more than 30 degrees.
SharpAngles sharp_angles(const Poly_Triangulation& closed_surface);
