// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/base/box_diagonal.hpp"

#include <vector>

#include <gtest/gtest.h>

namespace tessera {
namespace {

TEST(BoundingBox, HasTheLeastAndTheLargestOfEachAxis)
{
  const std::vector<double> xyz{1.0, 5.0, -3.0, -2.0, 6.0, 0.0, 0.0, 3.0, 9.0};
  EXPECT_EQ(bounding_box(xyz), (std::array<Vec3, 2>{{{-2.0, 3.0, -3.0}, {1.0, 6.0, 9.0}}}));
}

TEST(BoundingBox, OfOnePointIsThePoint)
{
  const std::vector<double> xyz{-1.0, -2.0, -3.0};
  EXPECT_EQ(bounding_box(xyz), (std::array<Vec3, 2>{{{-1.0, -2.0, -3.0}, {-1.0, -2.0, -3.0}}}));
}

TEST(BoxDiagonal, IsTheLengthFromCornerToCorner)
{
  // 2, 3 and 6 have the diagonal 7.
  EXPECT_EQ(box_diagonal(std::vector<double>{1.0, 0.0, 6.0, -1.0, 3.0, 0.0}), 7.0);
}

TEST(BoxDiagonal, IsZeroOfLessThanTwoPoints)
{
  EXPECT_EQ(box_diagonal({}), 0.0);
  EXPECT_EQ(box_diagonal(std::vector<double>{1.0, 2.0, 3.0}), 0.0);
}

}  // namespace
}  // namespace tessera
