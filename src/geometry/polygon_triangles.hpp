// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "geometry/plane_mesh.hpp"

namespace tessera::geometry {

/// @brief Triangles of a polygon with holes, without new points: ears are cut off, what has none is
/// filled such that least folds back, then edges are swapped until they are Delaunay's. Sides of
/// the polygon stay as they are. Local.
///
/// It takes no constrained Delaunay triangulation of a library: boundary points must stay those of
/// the neighbours, and a few hundred points need no speed.
/// @param[in] loops The outer one first, counter-clockwise; holes clockwise. Points may coincide
/// with their neighbours, and one point may be on several loops. Loops may cross themselves and
/// each other by a little, as those of files do whose curves are off the surface by their
/// tolerance.
/// @param[in] tolerance Where loops touch, what is thinner than this lies between them, not in a
/// hole.
/// @return No triangles if the loops cross by more than a little.
[[nodiscard]] PlaneMesh triangulate_polygon(std::vector<PlaneMesh::Point> points,
                                            const std::vector<PlaneMesh::Loop>& loops,
                                            double tolerance = 0.0);

}  // namespace tessera::geometry
