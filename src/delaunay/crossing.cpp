// SPDX-License-Identifier: BSD-3-Clause
#include "delaunay/crossing.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "tessera/delaunay/predicates.hpp"

// Two convex polygons in one plane overlap unless the line through a side of one of them has them
// on different sides. What lies on which side of a line in a plane is told by points off the plane,
// so that orient3d() answers all.
namespace tessera::delaunay {
namespace {

using Triangle = std::array<Vec3, 3>;
using Tet = std::array<Vec3, 4>;

// Whether a side of `a` has `b` beyond it, as seen from `apex`, from where both are positive.
bool has_separating_side(const Triangle& a, const Triangle& b, const Vec3& apex)
{
  for (std::size_t i = 0; i < 3; ++i) {
    const auto is_beyond = [&](const Vec3& p) {
      return orient3d(a[i], a[(i + 1) % 3], p, apex) <= 0;
    };
    if (std::ranges::all_of(b, is_beyond)) return true;
  }
  return false;
}

Triangle positive_from(const Vec3& apex, Triangle triangle)
{
  if (orient3d(triangle[0], triangle[1], triangle[2], apex) < 0)
    std::swap(triangle[1], triangle[2]);
  return triangle;
}

// Triangles of one plane.
bool overlap(Triangle a, Triangle b, const Vec3& apex)
{
  a = positive_from(apex, a);
  b = positive_from(apex, b);
  return !has_separating_side(a, b, apex) && !has_separating_side(b, a, apex);
}

// Corners of a tet by their place above, on and below the plane of a triangle: 1, 0, -1.
using Sides = std::array<int, 4>;

Sides sides_of(const Tet& tet, const Triangle& triangle)
{
  Sides sides{};
  for (std::size_t c = 0; c < 4; ++c) {
    sides[c] = orient3d(triangle[0], triangle[1], triangle[2], tet[c]);
  }
  return sides;
}

// Whether the part of the plane that is in the tet lies beyond the side of the triangle that goes
// from a to b. Its corners are corners of the tet, and points on edges from p above to q below: of
// such a point x, the tet (a, b, x, p) has the sign of (a, b, q, p).
bool is_section_beyond(const Vec3& a, const Vec3& b, const Tet& tet, const Sides& sides)
{
  for (std::size_t p = 0; p < 4; ++p) {
    if (sides[p] <= 0) continue;
    for (std::size_t q = 0; q < 4; ++q) {
      if (sides[q] <= 0 && orient3d(a, b, tet[q], tet[p]) > 0) return false;
    }
  }
  return true;
}

// Whether the triangle lies beyond the face opposite to a corner.
bool is_beyond_face(const Triangle& triangle, Tet tet, std::size_t corner)
{
  return std::ranges::all_of(triangle, [&](const Vec3& p) {
    tet[corner] = p;
    return orient3d(tet[0], tet[1], tet[2], tet[3]) <= 0;
  });
}

bool overlaps_a_face(const Tet& tet, const Triangle& triangle, const Sides& sides)
{
  if (std::ranges::count(sides, 0) != 3) return false;
  const auto apex = static_cast<std::size_t>(
      std::ranges::find_if(sides, [](int side) { return side != 0; }) - sides.begin());
  return overlap({tet[apex ^ 1U], tet[apex ^ 2U], tet[apex ^ 3U]}, triangle, tet[apex]);
}

}  // namespace

bool is_crossed(const Tet& tet, const Triangle& triangle)
{
  const Sides sides = sides_of(tet, triangle);
  if (std::ranges::count(sides, 1) == 0 || std::ranges::count(sides, -1) == 0) {
    return overlaps_a_face(tet, triangle, sides);
  }
  for (std::size_t i = 0; i < 3; ++i) {
    if (is_section_beyond(triangle[i], triangle[(i + 1) % 3], tet, sides)) return false;
  }
  for (std::size_t c = 0; c < 4; ++c) {
    if (is_beyond_face(triangle, tet, c)) return false;
  }
  return true;
}

}  // namespace tessera::delaunay
