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

/// @brief Twice the area of a triangle, with its sign.
[[nodiscard]] inline double turn(const PlaneMesh::Point& a, const PlaneMesh::Point& b,
                                 const PlaneMesh::Point& c)
{
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

/// @brief The area inside of a loop: above 0 if it runs counter-clockwise.
[[nodiscard]] double signed_area(const std::vector<PlaneMesh::Point>& points,
                                 const PlaneMesh::Loop& loop);
/// @brief The length of a loop, back to its first point.
[[nodiscard]] double length_around(const std::vector<PlaneMesh::Point>& points,
                                   const PlaneMesh::Loop& loop);

/// @brief Swaps inner edges until they are Delaunay's. Local.
void swap_to_delaunay(PlaneMesh& mesh);

/// @brief Halves inner edges that `is_bad(a, b)` names, until there is none or the mesh has
/// `most_points`. Sides of the polygon stay whole.
/// @param[in] is_bad Of the ends of an edge, which are in `mesh.points`. Local.
void refine_inside(
    PlaneMesh& mesh,
    const std::function<bool(const PlaneMesh::Point&, const PlaneMesh::Point&)>& is_bad,
    std::size_t most_points);

}  // namespace tessera::geometry
