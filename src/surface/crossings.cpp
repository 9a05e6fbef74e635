// SPDX-License-Identifier: BSD-3-Clause
#include "surface/crossings.hpp"

#include <algorithm>
#include <utility>

#include "tessera/delaunay/predicates.hpp"

#include "surface/editable_surface.hpp"

namespace tessera::surface {
namespace {

// Where the edge, whose ends seem to be on different sides of the triangle's plane, goes through
// it; also at its rim if that counts, as no tets fit between two edges that meet. Exact: triangles
// of one plane, as that of a side that was turned, are off it by rounding.
std::optional<Vec3> piercing(const Vec3& from, const Vec3& to, double above, double below,
                             const std::array<Vec3, 3>& triangle, AtRim at_rim)
{
  int side = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const int of_edge = delaunay::orient3d(from, to, triangle[i], triangle[(i + 1) % 3]);
    if (of_edge * side < 0 || (of_edge == 0 && at_rim == AtRim::passes)) return std::nullopt;
    if (of_edge != 0) side = of_edge;
  }
  const auto& [a, b, c] = triangle;
  if (delaunay::orient3d(a, b, c, from) * delaunay::orient3d(a, b, c, to) >= 0) return std::nullopt;
  return from + (above / (above - below)) * (to - from);
}

// Of an edge of a through b, whose normal is given. One that begins at the corner that both share
// does not go through. Most pairs end at the first test: all of `a` is on one side of b's plane.
std::optional<Vec3> edge_through(const PlacedTriangle& a, const PlacedTriangle& b,
                                 const Vec3& normal, std::size_t shared_of_a, AtRim at_rim)
{
  std::array<double, 3> above{};
  for (std::size_t c = 0; c < 3; ++c) {
    above[c] = c == shared_of_a ? 0.0 : dot(normal, a.corners[c] - b.corners[0]);
  }
  const auto [lowest, highest] = std::minmax({above[0], above[1], above[2]});
  if (lowest >= 0.0 || highest <= 0.0) return std::nullopt;
  for (std::size_t c = 0; c < 3; ++c) {
    const std::size_t next = (c + 1) % 3;
    if (above[c] * above[next] >= 0.0) continue;
    const auto place =
        piercing(a.corners[c], a.corners[next], above[c], above[next], b.corners, at_rim);
    if (place) return place;
  }
  return std::nullopt;
}

std::optional<Vec3> crossing(const PlacedTriangle& a, const Vec3& normal_of_a,
                             const PlacedTriangle& b, const Vec3& normal_of_b, AtRim at_rim)
{
  constexpr std::size_t kNone = 3;
  const bool is_one_patch = a.patch != kNoIndex && a.patch == b.patch;
  std::size_t shared_of_a = kNone;
  std::size_t shared_of_b = kNone;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      if (a.vertices[i] != b.vertices[j]) continue;
      if (is_one_patch || shared_of_a != kNone) return std::nullopt;
      shared_of_a = i;
      shared_of_b = j;
    }
  }
  const auto place = edge_through(a, b, normal_of_b, shared_of_a, at_rim);
  return place ? place : edge_through(b, a, normal_of_a, shared_of_b, at_rim);
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

std::optional<Vec3> crossing(const PlacedTriangle& a, const PlacedTriangle& b, AtRim at_rim)
{
  return crossing(a, normal_of(a.corners), b, normal_of(b.corners), at_rim);
}

CrossingGuard::CrossingGuard(const PatchSurface& surface, std::vector<Box> guarded, AtRim at_rim)
    : triangles_(placed(surface)),
      tree_(boxes_of(triangles_)),
      guarded_(std::move(guarded)),
      at_rim_(at_rim)
{
}

bool CrossingGuard::is_at(const Box& box) const
{
  bool is_found = false;
  guarded_.visit([&](const Box& other) { return !is_found && other.touches(box); },
                 [&](LocalIndex /*item*/) { is_found = true; });
  return is_found;
}

void CrossingGuard::find_near(const Box& box, std::span<const LocalIndex> without)
{
  near_.clear();
  tree_.visit([&](const Box& other) { return other.touches(box); },
              [&](LocalIndex t) {
                if (std::ranges::find(without, t) == without.end()) {
                  const std::array<Vec3, 3>& p = triangles_[at(t)].corners;
                  near_.push_back({box_of(p), normal_of(p), t});
                }
              });
}

// Pairs in which some of `some` cut each other or those that are near.
int CrossingGuard::count_near(std::span<const PlacedTriangle> some) const
{
  int count = 0;
  for (std::size_t i = 0; i < some.size(); ++i) {
    const Box box = box_of(some[i].corners);
    const Vec3 normal = normal_of(some[i].corners);
    for (const Near& other : near_) {
      if (!other.box.touches(box)) continue;
      const PlacedTriangle& found = triangles_[at(other.triangle)];
      count += crossing(some[i], normal, found, other.normal, at_rim_) ? 1 : 0;
    }
    for (std::size_t j = 0; j < i; ++j) count += crossing(some[i], some[j], at_rim_) ? 1 : 0;
  }
  return count;
}

bool CrossingGuard::allows(std::span<const LocalIndex> old, std::span<const PlacedTriangle> made)
{
  Box around;
  for (const PlacedTriangle& one : made) around.include(box_of(one.corners));
  if (!is_at(around)) return true;
  find_near(around, old);
  const int after = count_near(made);
  if (after == 0) return true;
  std::vector<PlacedTriangle> before;
  around = Box{};
  for (const LocalIndex t : old) {
    before.push_back(triangles_[at(t)]);
    around.include(tree_.box(t));
  }
  find_near(around, old);
  return after <= count_near(before);
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

}  // namespace tessera::surface
