// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/base/triangle.hpp"

#include <array>
#include <vector>

#include <gtest/gtest.h>

namespace tessera {
namespace {

constexpr std::array<Vec3, 3> kTriangle{{{0.0, 0.0, 1.0}, {3.0, 0.0, 1.0}, {0.0, 4.0, 1.0}}};

TEST(Triangle, HasANormalTwiceAsLongAsItsArea)
{
  EXPECT_EQ(normal_of(kTriangle), (Vec3{0.0, 0.0, 12.0}));
  EXPECT_EQ(unit_normal_of(kTriangle), (Vec3{0.0, 0.0, 1.0}));
  EXPECT_EQ(triangle_area(kTriangle), 6.0);
}

TEST(Triangle, HasNoNormalWithoutAnArea)
{
  EXPECT_EQ(unit_normal_of({kTriangle[0], kTriangle[1], kTriangle[1]}), Vec3{});
}

TEST(Triangle, HasAMiddleAndALongestSide)
{
  const Vec3 middle = middle_of(kTriangle);
  EXPECT_DOUBLE_EQ(middle[0], 1.0);
  EXPECT_DOUBLE_EQ(middle[1], 4.0 / 3.0);
  EXPECT_DOUBLE_EQ(middle[2], 1.0);
  EXPECT_EQ(longest_side(kTriangle), 5.0);
}

TEST(Triangle, CentroidIsThatOfTheSurfaceHoweverItIsCut)
{
  const std::array<Vec3, 4> square{
      {{0.0, 0.0, 0.0}, {2.0, 0.0, 0.0}, {2.0, 2.0, 0.0}, {0.0, 2.0, 0.0}}};
  const Vec3 off{0.25, 0.0, 0.0};
  std::vector<std::array<Vec3, 3>> triangles;
  for (std::size_t side = 0; side < 4; ++side)
    triangles.push_back({square[side], square[(side + 1) % 4], off});
  const Vec3 centroid = centroid_of(triangles);
  EXPECT_DOUBLE_EQ(centroid[0], 1.0);
  EXPECT_DOUBLE_EQ(centroid[1], 1.0);
  EXPECT_EQ(centroid[2], 0.0);
}

}  // namespace
}  // namespace tessera
