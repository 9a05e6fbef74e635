// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include <Geom_Surface.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>

#include "geometry/polygon_triangles.hpp"

namespace tessera::cad {

/// @brief How near triangles follow curves and surfaces.
struct Closeness {
  double deflection = 0.0;  ///< Model length unit.
  double angle = 0.0;       ///< Between neighbours along a curve, radians.
};

/// @brief One side of a face: an edge, and where its points are in the face's polygon.
struct FaceSide {
  TopoDS_Edge edge{};  ///< With its orientation in the upright face.
  std::vector<double> t{};
  std::vector<geometry::PlaneMesh::Point> uv{};
  std::vector<LocalIndex> nodes{};  ///< In the order of `t`.
};

/// @brief The boundary of a face as polygons in its parameters.
struct FaceLoops {
  std::vector<FaceSide> sides{};
  std::vector<geometry::PlaneMesh::Point> uv{};  ///< Of all nodes.
  std::vector<geometry::PlaneMesh::Loop>
      loops{};  ///< The outer one first; empty if they do not close.
};

/// @brief Points of an edge are those that a triangulation of a neighbour has there already; else
/// new ones. Where the face's own curves in parameters are far from the curves in space, points
/// are projected: what the neighbours share is the curve in space.
/// @param[in] face Upright: without the orientation that a solid gives it.
/// @throws Standard_Failure
[[nodiscard]] FaceLoops loops_of(const TopoDS_Face& face, const Closeness& closeness);

/// @brief Lengths of the surface's derivatives by its parameters: root of the mean square over some
/// points of it, 0 without any.
[[nodiscard]] std::array<double, 2> parameter_speeds(
    const Handle(Geom_Surface) & surface, const std::vector<geometry::PlaneMesh::Point>& uv);

}  // namespace tessera::cad
