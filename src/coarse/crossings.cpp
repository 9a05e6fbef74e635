// SPDX-License-Identifier: BSD-3-Clause
#include "coarse/crossings.hpp"

#include <algorithm>

namespace tessera::coarse {
namespace {

// Six times the signed volume of a tet.
double volume6(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d)
{
  return dot(cross(b - a, c - a), d - a);
}

// Where the edge goes through the inside of the triangle.
std::optional<Vec3> piercing(const Vec3& from, const Vec3& to, const std::array<Vec3, 3>& triangle)
{
  const double above = volume6(triangle[0], triangle[1], triangle[2], from);
  const double below = volume6(triangle[0], triangle[1], triangle[2], to);
  if (above * below >= 0.0) return std::nullopt;
  std::array<double, 3> sides{};
  for (std::size_t c = 0; c < 3; ++c) {
    sides[c] = volume6(from, to, triangle[c], triangle[(c + 1) % 3]);
  }
  const bool is_inside = (sides[0] > 0.0 && sides[1] > 0.0 && sides[2] > 0.0)
                         || (sides[0] < 0.0 && sides[1] < 0.0 && sides[2] < 0.0);
  if (!is_inside) return std::nullopt;
  return from + (above / (above - below)) * (to - from);
}

// An edge that begins at a corner of the triangle does not go through it.
std::optional<Vec3> edge_through(const PlacedTriangle& edges_of, const PlacedTriangle& triangle)
{
  for (std::size_t c = 0; c < 3; ++c) {
    const std::size_t next = (c + 1) % 3;
    const auto is_end = [&](LocalIndex corner) {
      return corner == edges_of.vertices[c] || corner == edges_of.vertices[next];
    };
    if (std::ranges::any_of(triangle.vertices, is_end)) continue;
    const auto place = piercing(edges_of.corners[c], edges_of.corners[next], triangle.corners);
    if (place) return place;
  }
  return std::nullopt;
}

std::vector<PlacedTriangle> placed(const PatchSurface& surface)
{
  std::vector<PlacedTriangle> triangles;
  triangles.reserve(surface.triangles.size());
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    triangles.push_back({surface.triangles[t], surface.corners(t)});
  }
  return triangles;
}

std::vector<Box> boxes_of(std::span<const PlacedTriangle> triangles)
{
  std::vector<Box> boxes;
  boxes.reserve(triangles.size());
  for (const PlacedTriangle& one : triangles) boxes.push_back(box_of(one.corners));
  return boxes;
}

}  // namespace

std::optional<Vec3> crossing(const PlacedTriangle& a, const PlacedTriangle& b)
{
  const auto num_shared = std::ranges::count_if(a.vertices, [&](LocalIndex v) {
    return std::ranges::find(b.vertices, v) != b.vertices.end();
  });
  if (num_shared > 1) return std::nullopt;
  const auto place = edge_through(a, b);
  return place ? place : edge_through(b, a);
}

CrossingGuard::CrossingGuard(const PatchSurface& surface)
    : triangles_(placed(surface)), tree_(boxes_of(triangles_))
{
}

// Pairs in which some of `some` cut each other or those that are near.
int CrossingGuard::count(std::span<const PlacedTriangle> some,
                         std::span<const LocalIndex> near) const
{
  int count = 0;
  for (std::size_t i = 0; i < some.size(); ++i) {
    const Box box = box_of(some[i].corners);
    for (const LocalIndex t : near) {
      if (!tree_.box(t).touches(box)) continue;
      count += crossing(some[i], triangles_[at(t)]) ? 1 : 0;
    }
    for (std::size_t j = 0; j < i; ++j) count += crossing(some[i], some[j]) ? 1 : 0;
  }
  return count;
}

bool CrossingGuard::allows(std::span<const LocalIndex> old,
                           std::span<const PlacedTriangle> made) const
{
  std::vector<PlacedTriangle> before;
  Box around;
  for (const PlacedTriangle& one : made) around.include(box_of(one.corners));
  std::vector<LocalIndex> near;
  const auto find_near = [&] {
    near.clear();
    tree_.visit([&](const Box& box) { return box.touches(around); },
                [&](LocalIndex t) {
                  if (std::ranges::find(old, t) == old.end()) near.push_back(t);
                });
  };
  find_near();
  const int after = count(made, near);
  if (after == 0) return true;
  for (const LocalIndex t : old) {
    before.push_back(triangles_[at(t)]);
    around.include(tree_.box(t));
  }
  find_near();
  return after <= count(before, near);
}

void CrossingGuard::change(LocalIndex t, const PlacedTriangle& triangle)
{
  triangles_[at(t)] = triangle;
  tree_.change(t, box_of(triangle.corners));
}

void CrossingGuard::add(const PlacedTriangle& triangle, LocalIndex beside)
{
  triangles_.push_back(triangle);
  tree_.add(box_of(triangle.corners), beside);
}

void CrossingGuard::remove(LocalIndex t) { tree_.change(t, Box{}); }

}  // namespace tessera::coarse
