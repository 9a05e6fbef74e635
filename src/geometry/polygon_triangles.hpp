// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <functional>
#include <vector>

#include "tessera/base/types.hpp"

namespace tessera::geometry {

/// @brief Triangles in a plane. All run counter-clockwise.
struct PlaneMesh {
  using Point = std::array<double, 2>;
  using Triangle = std::array<LocalIndex, 3>;
  using Loop = std::vector<LocalIndex>;

  std::vector<Point> points{};
  std::vector<Triangle> triangles{};
};

/// @brief Triangles of a polygon with holes, without new points: ears are cut off, then edges are
/// swapped until they are Delaunay's. Sides of the polygon stay as they are. Local.
///
/// It takes no constrained Delaunay triangulation of a library: boundary points must stay those of
/// the neighbours, and a few hundred points need no speed.
/// @param[in] loops The outer one first, counter-clockwise; holes clockwise. Points may coincide
/// with their neighbours.
/// @return No triangles if the loops cross themselves or each other.
[[nodiscard]] PlaneMesh triangulate_polygon(std::vector<PlaneMesh::Point> points,
                                            const std::vector<PlaneMesh::Loop>& loops);

/// @brief Halves inner edges that `is_bad(a, b)` names, until there is none or the mesh has
/// `most_points`. Sides of the polygon stay whole.
/// @param[in] is_bad Of the ends of an edge, which are in `mesh.points`. Local.
void refine_inside(
    PlaneMesh& mesh,
    const std::function<bool(const PlaneMesh::Point&, const PlaneMesh::Point&)>& is_bad,
    std::size_t most_points);

}  // namespace tessera::geometry
