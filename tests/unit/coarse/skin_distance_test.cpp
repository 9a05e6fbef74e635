// SPDX-License-Identifier: BSD-3-Clause
#include "coarse/domains/skin_distance.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "support/random_points.hpp"

#include "voxel_skin.hpp"

namespace tessera::coarse {
namespace {

std::vector<Vec3> some_points(double low, double high)
{
  const std::vector<double> xyz = testing::points_in_cube(2000);
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < xyz.size() / 3; ++i) {
    const Vec3 p = point_at(std::span(xyz), i) + Vec3{1, 1, 1};
    points.push_back(0.5 * (high - low) * p + Vec3{low, low, low});
  }
  return points;
}

TEST(SkinDistance, OfACube)
{
  constexpr double kLeast = 0.1;
  const surface::DomainSkin skin = testing::cube_skin(2, 1.0);
  const SkinDistance distance(skin);
  for (const Vec3& p : some_points(-0.5, 2.5)) {
    const double depth = std::min(std::ranges::min(p), 2.0 - std::ranges::max(p));
    EXPECT_EQ(distance.is_inside(p, kLeast), depth >= kLeast) << p[0] << ' ' << p[1] << ' ' << p[2];
  }
}

// Signed distance to a quarter of space, of points in the L-shape's plane.
double l_shape_depth(const Vec3& p, double size)
{
  const double half = 0.5 * size;
  const double walls = std::min({p[0], p[1], p[2], size - p[0], size - p[1], size - p[2]});
  const double x = half - p[0];
  const double y = half - p[1];
  if (x < 0.0 && y < 0.0) return -1.0;
  const double to_notch = std::hypot(std::max(x, 0.0), std::max(y, 0.0));
  return std::min(walls, to_notch);
}

TEST(SkinDistance, OfAnLShape)
{
  constexpr double kLeast = 0.15;
  const surface::DomainSkin skin = testing::l_shape_skin(4, 0.5);
  const SkinDistance distance(skin);
  for (const Vec3& p : some_points(-0.3, 2.3)) {
    EXPECT_EQ(distance.is_inside(p, kLeast), l_shape_depth(p, 2.0) >= kLeast)
        << p[0] << ' ' << p[1] << ' ' << p[2];
  }
}

// Points whose nearest place is a vertex or a point of an edge, of a concave corner too.
TEST(SkinDistance, NearVerticesAndEdges)
{
  const surface::DomainSkin skin = testing::l_shape_skin(2, 1.0);
  const SkinDistance distance(skin);
  const double e = 1e-3;
  for (const double z : {1.0, 0.7}) {  // The edge's vertex, and between its vertices.
    EXPECT_TRUE(distance.is_inside({1 - e, 1 - e, z}, 0.5 * e)) << z;
    EXPECT_FALSE(distance.is_inside({1 - e, 1 - e, z}, 1.5 * e)) << z;
    EXPECT_FALSE(distance.is_inside({1 + e, 1 + e, z}, 0.5 * e)) << z;
    EXPECT_FALSE(distance.is_inside({-e, -e, z}, 0.5 * e)) << z;
    EXPECT_TRUE(distance.is_inside({e, e, z}, 0.5 * e)) << z;
  }
  EXPECT_FALSE(distance.is_inside({-e, -e, -e}, 0.5 * e));
  EXPECT_FALSE(distance.is_inside({2 + e, 1 + e, 2 + e}, 0.5 * e));
  EXPECT_FALSE(distance.is_inside({1 + e, 1 + e, 2 + e}, 0.5 * e));
  EXPECT_FALSE(distance.is_inside({-e, 1, 1}, 0.5 * e));
}

TEST(SkinDistance, OfABall)
{
  const surface::DomainSkin skin = testing::ball_skin(6);
  const SkinDistance distance(skin);
  constexpr double kSag = 0.06;  // Of triangles below the sphere.
  for (const Vec3& p : some_points(-1.2, 1.2)) {
    const double depth = 1.0 - norm(p);
    if (depth < 0.2) {
      EXPECT_FALSE(distance.is_inside(p, 0.2));
    }
    if (depth > 0.2 + kSag) {
      EXPECT_TRUE(distance.is_inside(p, 0.2));
    }
    if (depth < 0.0) {
      EXPECT_FALSE(distance.is_inside(p, 1e-9));
    }
  }
}

// Points come line by line, as those of a lattice do.
TEST(InsideFinder, SaysWhatASearchOfEachPointSays)
{
  const surface::DomainSkin skin = testing::ball_skin(6);
  const SkinDistance distance(skin);
  InsideFinder finder(distance);
  int num_inside = 0;
  for (int i = 0; i < 40 * 40 * 40; ++i) {
    const Vec3 p = 0.06 * Vec3{i / 1600 - 19.5, i / 40 % 40 - 19.5, i % 40 - 19.5};
    const bool is_inside = distance.is_inside(p, 0.05);
    ASSERT_EQ(finder.is_inside(p, 0.05), is_inside) << p[0] << ' ' << p[1] << ' ' << p[2];
    num_inside += is_inside ? 1 : 0;
  }
  EXPECT_GT(num_inside, 10'000);
  EXPECT_LT(num_inside, 40'000);
}

}  // namespace
}  // namespace tessera::coarse
