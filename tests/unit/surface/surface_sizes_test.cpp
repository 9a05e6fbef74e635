// SPDX-License-Identifier: BSD-3-Clause
#include "surface/sizes/surface_sizes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace tessera::surface {
namespace {

constexpr double kHeight = 5.0;

using Outline = std::vector<std::array<double, 2>>;

// `count` + 1 points on a circle, from an angle on.
void add_arc(const std::array<double, 2>& middle, double radius, double from, double to, int count,
             Outline& outline)
{
  for (int i = 0; i <= count; ++i) {
    const double angle = (from + (to - from) * i / count) * std::numbers::pi / 180.0;
    outline.push_back({middle[0] + radius * std::cos(angle), middle[1] + radius * std::sin(angle)});
  }
}

// A body with this convex outline, of one patch without curves.
PatchSurface prism(const Outline& outline)
{
  PatchSurface surface;
  const auto n = static_cast<LocalIndex>(outline.size());
  for (const double z : {0.0, kHeight}) {
    for (const auto& [x, y] : outline) surface.vertex_xyz.push_back({x, y, z});
  }
  for (LocalIndex i = 0; i < n; ++i) {
    const LocalIndex next = (i + 1) % n;
    surface.triangles.push_back({i, next, n + next});
    surface.triangles.push_back({i, n + next, n + i});
    if (i == 0 || next == 0) continue;
    surface.triangles.push_back({0, next, i});
    surface.triangles.push_back({n, n + i, n + next});
  }
  surface.vertex_is_fixed.assign(surface.vertex_xyz.size(), 0);
  surface.triangle_patch.assign(surface.triangles.size(), 0);
  surface.patch_materials = {{1, 0}};
  return surface;
}

// The sizes at the vertices of a surface.
std::vector<double> sizes_of(const PatchSurface& surface, const CoarseOptions& options)
{
  SizeFunction function(options);
  function.limit(bent_places_of(surface, options));
  std::vector<double> sizes;
  for (const Vec3& place : surface.vertex_xyz) sizes.push_back(function(place));
  return sizes;
}

TEST(SizeFunction, IsBelowALimitWhereOneOfItsSizesIs)
{
  SizeFunction function({.max_size = 1.0, .grading = 0.3});
  function.limit({{{Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0, 1, 0}}, 0.1},
                  {{Vec3{3, 3, 3}, Vec3{3, 3, 3}, Vec3{3, 3, 3}}, 0.2}});
  const std::array places{Vec3{0.2, 0.2, 0.3}, Vec3{0.4, 0.2, 0.6}, Vec3{2.0, 2.5, 2.0}};
  double least = function.largest();
  for (const Vec3& place : places) least = std::min(least, function(place));
  EXPECT_FALSE(function.is_below(least, places));
  EXPECT_TRUE(function.is_below(1.0001 * least, places));
  EXPECT_TRUE(function.is_below(1.1, std::span(places).first(1))) << "no place wants more than 1";
  EXPECT_FALSE(SizeFunction({.max_size = 1.0}).is_below(1.0, places)) << "without a source";
}

TEST(BentPlaces, GoRoundAWireThinnerThanTheLeastSize)
{
  Outline circle;
  add_arc({0.0, 0.0}, 1.0, 0.0, 337.5, 15, circle);
  for (const double size : sizes_of(prism(circle), {.max_size = 20.0}))
    EXPECT_NEAR(size, 1.0, 0.05) << "six edges, not three";
}

TEST(BentPlaces, DoNotResolveAWireOfNearlyNothing)
{
  Outline circle;
  add_arc({0.0, 0.0}, 1.0, 0.0, 337.5, 15, circle);
  for (const double size : sizes_of(prism(circle), {.max_size = 200.0}))
    EXPECT_NEAR(size, 8.0, 1e-9);
}

TEST(BentPlaces, DoNotResolveARoundedEdgeThinnerThanTheLeastSize)
{
  Outline square{{0.0, 0.0}, {9.0, 0.0}};
  add_arc({8.0, 8.0}, 1.0, 0.0, 90.0, 4, square);
  square.push_back({0.0, 9.0});
  const std::vector<double> sizes = sizes_of(prism(square), {.max_size = 20.0});
  EXPECT_NEAR(std::ranges::min(sizes), 2.0, 1e-9) << "a tenth of the largest size";
}

}  // namespace
}  // namespace tessera::surface
