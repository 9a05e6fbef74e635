// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "tessera/sizing/coarse_sizes.hpp"

#include "support/meshes.hpp"

namespace tessera::sizing {
namespace {

using testing::kuhn_cube;

constexpr double kGrowth = 0.3;
const Vec3 kPlace{0.4, 0.37, 0.45};  // Inside of a tet.

SizeOptions small_ball(double size)
{
  return {.target = 1.0, .regions = {{Ball{kPlace, size}, size, kGrowth}}};
}

mesh::SizePoints points_for(const SizeOptions& options, int levels = 1)
{
  const mesh::CoarseMesh cube = kuhn_cube(1);
  return coarse_size_points(cube, levels, SizeField(options, cube), {4.0, 2.0});
}

TEST(CoarseSizePoints, AreNotThereWhereLevelsReach)
{
  EXPECT_TRUE(points_for({.target = 1.0}).size.empty());
  EXPECT_TRUE(points_for(small_ball(0.5)).size.empty());
  EXPECT_TRUE(points_for({.target = 0.1}, 4).size.empty());
}

TEST(CoarseSizePoints, AreThereWhereTheLargestLevelIsTooSmall)
{
  EXPECT_FALSE(points_for({.target = 0.1}, 1).size.empty());
}

TEST(CoarseSizePoints, FindASmallRegionInsideOfATet)
{
  const double size = 0.01;
  const mesh::SizePoints points = points_for(small_ball(size));
  ASSERT_FALSE(points.size.empty());
  double nearest = 1.0;
  for (std::size_t i = 0; i < points.size.size(); ++i) {
    const double distance = norm(point_at(std::span(points.xyz), i) - kPlace);
    nearest = std::min(nearest, distance);
    const double wanted = std::min(1.0, size + kGrowth * std::max(0.0, distance - size));
    EXPECT_NEAR(points.size[i], 4.0 * wanted, 1e-12);
  }
  EXPECT_LT(nearest, 4.0 * size);
}

TEST(LongestPartInSizes, IsWhereTheSizeIsSmallest)
{
  const mesh::CoarseMesh cube = kuhn_cube(1);
  const double size = 0.01;
  const SizeField sizes(small_ball(size), cube);
  const PartInSizes longest = longest_part_in_sizes(cube, 1, sizes, 4.0);
  EXPECT_LT(norm(longest.place - kPlace), 4.0 * size);
  const double half_a_diagonal = 0.5 * std::sqrt(3.0);
  EXPECT_NEAR(longest.in_sizes * longest.size, half_a_diagonal, 1e-12);
  EXPECT_NEAR(longest_part_in_sizes(cube, 3, sizes, 4.0).in_sizes, longest.in_sizes / 4.0, 1e-9);
}

}  // namespace
}  // namespace tessera::sizing
