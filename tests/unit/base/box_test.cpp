// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/base/box.hpp"

#include <array>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace tessera {
namespace {

constexpr Box kBox{{0.0, 1.0, 2.0}, {1.0, 4.0, 4.0}};

TEST(Box, IsEmptyAsItBeginsAndTouchesNothing)
{
  const Box box;
  EXPECT_TRUE(box.is_empty());
  EXPECT_FALSE(box.touches(kBox));
  EXPECT_FALSE(kBox.touches(box));
  EXPECT_FALSE(box.touches(box));
  EXPECT_FALSE(box.holds(Vec3{}));
  EXPECT_TRUE(kBox.holds(box));
}

TEST(Box, TouchesWhatSharesACornerOnly)
{
  const Box box{{0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}};
  EXPECT_TRUE(box.touches({{1.0, 1.0, 1.0}, {2.0, 2.0, 2.0}}));
  for (std::size_t axis = 0; axis < 3; ++axis) {
    Box other{{1.0, 1.0, 1.0}, {2.0, 2.0, 2.0}};
    other.low[axis] = 1.1;
    EXPECT_FALSE(box.touches(other));
    EXPECT_FALSE(other.touches(box));
  }
}

TEST(Box, HoldsItselfAndWhatIsInside)
{
  const Box box = box_of(std::array<Vec3, 3>{{{0.0, 3.0, 1.0}, {2.0, 0.0, 1.0}, {1.0, 1.0, -4.0}}});
  EXPECT_EQ(box.low, (Vec3{0.0, 0.0, -4.0}));
  EXPECT_EQ(box.high, (Vec3{2.0, 3.0, 1.0}));
  EXPECT_TRUE(box.holds(box));
  for (std::size_t axis = 0; axis < 3; ++axis) {
    Box larger = box;
    larger.high[axis] += 0.5;
    EXPECT_TRUE(larger.holds(box));
    EXPECT_FALSE(box.holds(larger));
  }
}

TEST(Box, HoldsWhatItIncludes)
{
  const std::vector<Vec3> points{{1.0, -2.0, 0.5}, {-3.0, 4.0, 0.5}, {0.0, 0.0, 7.0}};
  const Box box = bounding_box(points);
  for (const Vec3& point : points) EXPECT_TRUE(box.holds(point));
  EXPECT_EQ(box.low, (Vec3{-3.0, -2.0, 0.5}));
  EXPECT_EQ(box.high, (Vec3{1.0, 4.0, 7.0}));
}

TEST(Box, HasTheDiagonalOfItsPoints)
{
  EXPECT_DOUBLE_EQ(kBox.diagonal(), std::sqrt(14.0));
  // 2, 3 and 6 have the diagonal 7.
  EXPECT_EQ(box_diagonal(std::vector<double>{1.0, 0.0, 6.0, -1.0, 3.0, 0.0}), 7.0);
  EXPECT_EQ(box_diagonal(std::vector<double>{1.0, 2.0, 3.0}), 0.0);
  EXPECT_EQ(box_diagonal({}), 0.0);
}

TEST(Box, HasTheFirstOfItsLongestSides)
{
  EXPECT_EQ(kBox.longest_axis(), 1U);
  EXPECT_EQ((Box{{0.0, 0.0, 0.0}, {2.0, 2.0, 2.0}}.longest_axis()), 0U);
}

TEST(Box, IsNearToPointsOutsideAndHoldsOthers)
{
  EXPECT_EQ(kBox.squared_distance({0.5, 2.0, 3.0}), 0.0);
  EXPECT_EQ(kBox.squared_distance({3.0, 2.0, 0.0}), 8.0);
  EXPECT_FALSE(kBox.holds(Vec3{1.5, 2.0, 3.0}));
  EXPECT_TRUE(kBox.widened(0.5).holds(Vec3{1.5, 2.0, 3.0}));
}

}  // namespace
}  // namespace tessera
