// SPDX-License-Identifier: BSD-3-Clause
#include <array>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "surface/wrap/caps.hpp"

namespace tessera::surface {
namespace {

using Corners = std::array<Vec3, 3>;

constexpr double kTolerance = 0.05;

std::vector<Corners> caps_of(const std::vector<Corners>& triangles)
{
  return hole_caps(FileTriangles(triangles), kTolerance);
}

double area_of(const std::vector<Corners>& triangles)
{
  double area = 0.0;
  for (const auto& [a, b, c] : triangles) area += triangle_area(a, b, c);
  return area;
}

double volume_of(const std::vector<Corners>& triangles)
{
  double volume = 0.0;
  for (const auto& [a, b, c] : triangles) volume += tet_volume({}, a, b, c);
  return volume;
}

std::vector<Corners> with(std::vector<Corners> triangles, const std::vector<Corners>& more)
{
  triangles.insert(triangles.end(), more.begin(), more.end());
  return triangles;
}

Vec3 on_ring(int i, int num_sides, double z)
{
  const double angle = 2.0 * std::numbers::pi * (i % num_sides) / num_sides;
  return {std::cos(angle), std::sin(angle), z};
}

// The side of a cylinder of radius 1, outwards.
std::vector<Corners> tube(double bottom, double top, int num_sides)
{
  std::vector<Corners> triangles;
  for (int i = 0; i < num_sides; ++i) {
    const Vec3 a = on_ring(i, num_sides, bottom);
    const Vec3 b = on_ring(i + 1, num_sides, bottom);
    const Vec3 c = on_ring(i + 1, num_sides, top);
    const Vec3 d = on_ring(i, num_sides, top);
    triangles.push_back({a, b, c});
    triangles.push_back({a, c, d});
  }
  return triangles;
}

TEST(WrapCaps, EndsOfATubeAreClosedByTheirPlanes)
{
  const std::vector<Corners> open = tube(0.0, 5.0, 32);
  const std::vector<Corners> caps = caps_of(open);
  EXPECT_EQ(caps.size(), 2U * 30U);
  const double disc = 16.0 * std::sin(2.0 * std::numbers::pi / 32.0);
  EXPECT_NEAR(area_of(caps), 2.0 * disc, 1e-12);
  EXPECT_NEAR(volume_of(with(open, caps)), 5.0 * disc, 1e-12);
}

TEST(WrapCaps, LongRimIsClosedAsWell)
{
  const std::vector<Corners> open = tube(0.0, 5.0, 1000);
  const std::vector<Corners> caps = caps_of(open);
  EXPECT_EQ(caps.size(), 2U * 998U);
  EXPECT_NEAR(volume_of(with(open, caps)), 5.0 * std::numbers::pi, 1e-3);
}

TEST(WrapCaps, EndWithinABodyStaysOpen)
{
  // Its lower end is in the middle of a closed cylinder.
  const std::vector<Corners> wide = tube(-5.0, 1.0, 32);
  std::vector<Corners> narrow = tube(-2.0, 6.0, 32);
  for (Corners& corners : narrow) {
    for (Vec3& p : corners) p = {0.3 * p[0], 0.3 * p[1], p[2]};
  }
  const std::vector<Corners> body = with(wide, caps_of(wide));
  const std::vector<Corners> caps = caps_of(with(body, narrow));
  ASSERT_EQ(caps.size(), 30U);
  for (const Corners& corners : caps) EXPECT_EQ(corners[0][2], 6.0);
}

TEST(WrapCaps, LooseTrianglesAndNarrowGapsGetNone)
{
  std::vector<Corners> loose = tube(0.0, 5.0, 32);
  for (auto& [a, b, c] : loose) {
    const Vec3 middle = (1.0 / 3.0) * (a + b + c);
    for (Vec3* p : {&a, &b, &c}) *p = middle + 0.99 * (*p - middle);
  }
  EXPECT_TRUE(caps_of(loose).empty());
}

TEST(WrapCaps, NothingOfAClosedSurface)
{
  const std::vector<Corners> open = tube(0.0, 5.0, 8);
  EXPECT_TRUE(caps_of(with(open, caps_of(open))).empty());
}

// A box without the side at x = 0, and a tooth that sticks out of its side at y = 1. The least area
// is that of the missing side and of the tooth itself, of which nothing would be left.
TEST(WrapCaps, CapLeavesTheSurfaceBeyondItsRim)
{
  const Vec3 x{1.0, 0.0, 0.0};
  const Vec3 a{};
  const Vec3 b{0.0, 1.0, 0.0};
  const Vec3 c{0.0, 1.0, 1.0};
  const Vec3 d{0.0, 0.0, 1.0};
  const Vec3 tip{-0.5, 1.0, 0.5};
  std::vector<Corners> open{{x + a, x + b, x + c}, {x + a, x + c, x + d}, {tip, c, b}};
  for (const auto& [p, q] : {std::pair{a, b}, {b, c}, {c, d}, {d, a}}) {
    open.push_back({p, q, x + q});
    open.push_back({p, x + q, x + p});
  }
  EXPECT_NEAR(volume_of(with(open, caps_of(open))), 1.0 + 0.5 / 3.0, 1e-12);
}

}  // namespace
}  // namespace tessera::surface
