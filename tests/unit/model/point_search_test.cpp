// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/model/point_search.hpp"

#include <gtest/gtest.h>

namespace tessera::model {
namespace {

TEST(SearchOfPoints, FindsTheNearestAndItsRow)
{
  const std::vector<Vec3> points{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {0, 0, -4}};
  const NearestPoint found = search_of_points(points).nearest({0, 3, 1});
  EXPECT_EQ(found.simplex, 2);
  EXPECT_EQ(found.xyz, (Vec3{0, 4, 0}));
  EXPECT_EQ(found.squared_distance, 2.0);
}

TEST(SearchOfPoints, TakesTheLowestRowOfEquallyNear)
{
  const std::vector<Vec3> points{{9, 9, 9}, {1, 0, 0}, {-1, 0, 0}, {1, 0, 0}};
  EXPECT_EQ(search_of_points(points).nearest({0, 0, 0}).simplex, 1);
}

TEST(SearchOfPoints, FindsTheOnlyPoint)
{
  const std::vector<Vec3> points{{1, 2, 3}};
  EXPECT_EQ(search_of_points(points).nearest({-7, 0, 0}).simplex, 0);
  EXPECT_EQ(search_of_points(points).nearest({1, 2, 3}).squared_distance, 0.0);
}

}  // namespace
}  // namespace tessera::model
