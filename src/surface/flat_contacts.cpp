// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/surface/flat_contacts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "tessera/base/box_tree.hpp"
#include "tessera/base/triangle.hpp"

namespace tessera::surface {
namespace {

using Corners = std::array<Vec3, 3>;

// All corners of `other` are so near to the plane.
bool is_in_plane(const Corners& p, const Vec3& normal, const Corners& other, double tolerance)
{
  return std::ranges::all_of(
      other, [&](const Vec3& corner) { return std::abs(dot(normal, corner - p[0])) <= tolerance; });
}

// How far the most inner corner of `other` is inside of the side of `p` that it is the least inside
// of; both in one plane.
double depth(const Corners& p, const Vec3& normal, const Corners& other)
{
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t c = 0; c < 3; ++c) {
    const Vec3 inwards = cross(normal, p[(c + 1) % 3] - p[c]);
    double most = -std::numeric_limits<double>::infinity();
    for (const Vec3& corner : other) most = std::max(most, dot(inwards, corner - p[c]));
    const double length = norm(inwards);
    if (length == 0.0) return 0.0;
    least = std::min(least, most / length);
  }
  return least;
}

// Convex parts of a plane are apart if a side of one of them has the other one outside.
bool lie_on_each_other(const Corners& a, const Vec3& normal_a, const Corners& b,
                       const Vec3& normal_b, double tolerance)
{
  if (!is_in_plane(a, normal_a, b, tolerance) && !is_in_plane(b, normal_b, a, tolerance)) {
    return false;
  }
  return std::min(depth(a, normal_a, b), depth(b, normal_b, a)) > tolerance;
}

}  // namespace

std::vector<std::array<std::size_t, 2>> find_flat_contacts(const PatchSurface& surface,
                                                           double tolerance)
{
  std::vector<Box> boxes;
  std::vector<Vec3> normals;
  boxes.reserve(surface.triangles.size());
  normals.reserve(surface.triangles.size());
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    boxes.push_back(box_of(surface.corners(t)));
    normals.push_back(unit_normal_of(surface.corners(t)));
  }
  const BoxTree tree(boxes);
  std::vector<std::array<std::size_t, 2>> found;
  for (std::size_t t = 0; t < boxes.size(); ++t) {
    const Corners corners = surface.corners(t);
    const Box around = boxes[t].widened(tolerance);
    tree.visit([&](const Box& box) { return box.touches(around); },
               [&](LocalIndex item) {
                 if (at(item) <= t) return;
                 const std::size_t other = at(item);
                 if (lie_on_each_other(corners, normals[t], surface.corners(other), normals[other],
                                       tolerance)) {
                   found.push_back({t, other});
                 }
               });
  }
  std::ranges::sort(found);
  return found;
}

}  // namespace tessera::surface
