// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/mesh/side_places.hpp"

#include <map>
#include <vector>

#include <gtest/gtest.h>

namespace tessera::mesh {
namespace {

// Two triangles beside each other, with other points at the places of 1 and 2: a crack.
const std::vector<double> kXyz{0, 0, 0, 6, 0, 0, 0, 6, 0, 6, 6, 0, 6, 0, 0, 0, 6, 0};

std::map<LocalIndex, Vec3> places_of(const std::vector<LocalIndex>& points)
{
  std::map<LocalIndex, Vec3> places;
  for_each_side_place(kXyz, points,
                      [&](LocalIndex point, const Vec3& place) { places.emplace(point, place); });
  return places;
}

TEST(ForEachSidePlace, GoesHalfWayToTheCentre)
{
  const auto places = places_of({0, 1, 2});
  ASSERT_EQ(places.size(), 3U);
  EXPECT_EQ(places.at(0), (Vec3{1.0, 1.0, 0.0}));
  EXPECT_EQ(places.at(1), (Vec3{4.0, 1.0, 0.0}));
  EXPECT_EQ(places.at(2), (Vec3{1.0, 4.0, 0.0}));
}

TEST(ForEachSidePlace, TellsPointsAtOnePositionApart)
{
  const auto here = places_of({0, 1, 2});
  const auto there = places_of({4, 3, 5});
  EXPECT_NE(here.at(1), there.at(4));
  EXPECT_NE(here.at(2), there.at(5));
}

TEST(ForEachSidePlace, TakesNodesToTheCentreOfTheCorners)
{
  // 3 stands for a node of second order: it is no corner, so it does not move the centre.
  const auto places = places_of({0, 1, 2, 3});
  EXPECT_EQ(places.at(0), (Vec3{1.0, 1.0, 0.0}));
  EXPECT_EQ(places.at(3), (Vec3{4.0, 4.0, 0.0}));
}

}  // namespace
}  // namespace tessera::mesh
