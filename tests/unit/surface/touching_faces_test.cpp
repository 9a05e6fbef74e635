// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/surface/touching_faces.hpp"

#include <gtest/gtest.h>

namespace tessera::surface {
namespace {

using Triangles = std::vector<std::array<LocalIndex, 3>>;

constexpr double kTolerance = 1e-9;

// A triangle across z, and further points.
std::vector<double> with_points(const std::vector<Vec3>& more)
{
  std::vector<double> xyz{0, 0, 0, 6, 0, 0, 0, 6, 0};
  for (const Vec3& point : more) xyz.insert(xyz.end(), point.begin(), point.end());
  return xyz;
}

const Triangles kTwo{{0, 1, 2}, {3, 4, 5}};

TEST(TouchingFaces, AreNoneOfNothingAndOfOne)
{
  EXPECT_FALSE(find_touching_faces({}, {}, kTolerance).has_value());
  EXPECT_FALSE(find_touching_faces(with_points({}), {{0, 1, 2}}, kTolerance).has_value());
}

TEST(TouchingFaces, AreNotThoseThatShareAnEdgeOrACorner)
{
  const auto xyz = with_points({{6, 6, 0}, {-1, 0, 1}, {0, -1, 1}});
  EXPECT_FALSE(find_touching_faces(xyz, {{0, 1, 2}, {2, 1, 3}}, kTolerance).has_value());
  EXPECT_FALSE(find_touching_faces(xyz, {{0, 1, 2}, {0, 4, 5}}, kTolerance).has_value());
}

TEST(TouchingFaces, HaveACornerInsideOfTheOther)
{
  const auto xyz = with_points({{1, 1, 0}, {1, 1, 5}, {2, 1, 5}});
  const auto found = find_touching_faces(xyz, kTwo, kTolerance);
  ASSERT_TRUE(found.has_value());
  EXPECT_EQ(found->place, (Vec3{1, 1, 0}));
  EXPECT_EQ(found->first, 1U);  // The one whose corner it is.
  EXPECT_EQ(found->second, 0U);
}

TEST(TouchingFaces, HaveACornerOnASideOfTheOther)
{
  const auto xyz = with_points({{3, 0, 0}, {3, -1, 5}, {4, -1, 5}});
  const auto found = find_touching_faces(xyz, kTwo, kTolerance);
  ASSERT_TRUE(found.has_value());
  EXPECT_EQ(found->place, (Vec3{3, 0, 0}));
}

// Six points at three places: neither knows the other's.
TEST(TouchingFaces, AreOneTriangleTwice)
{
  EXPECT_TRUE(find_touching_faces(with_points({{0, 0, 0}, {6, 0, 0}, {0, 6, 0}}), kTwo, kTolerance)
                  .has_value());
}

TEST(TouchingFaces, AreFoldedOntoEachOtherAtTheirEdge)
{
  const auto xyz = with_points({{2, 2, 0}});
  EXPECT_TRUE(find_touching_faces(xyz, {{0, 1, 2}, {1, 0, 3}}, kTolerance).has_value());
}

// All corners of the small one lie off the large one, and so do those of the large one: only the
// middle tells.
TEST(TouchingFaces, HaveAMiddleInsideOfTheOther)
{
  const auto xyz = with_points({{1, 1, -2}, {1, 1, 1}, {1, 1.5, 1}});
  const auto found = find_touching_faces(xyz, kTwo, kTolerance);
  ASSERT_TRUE(found.has_value());
  EXPECT_NEAR(found->place[1], 3.5 / 3.0, 1e-12);
}

TEST(TouchingFaces, AreNearerThanTheTolerance)
{
  for (const double off : {0.5, 2.0}) {
    const auto xyz = with_points({{1, 1, off * 1e-3}, {1, 1, 5}, {2, 1, 5}});
    EXPECT_EQ(find_touching_faces(xyz, kTwo, 1e-3).has_value(), off < 1.0);
  }
}

// Along each axis it is near enough.
TEST(TouchingFaces, AreNotThoseThatAreFartherOffAcrossTheAxes)
{
  for (const double off : {0.6, 0.9}) {
    const auto xyz = with_points({{-off * 1e-3, -off * 1e-3, 0}, {-1, -1, 5}, {-1, -2, 5}});
    EXPECT_EQ(find_touching_faces(xyz, kTwo, 1e-3).has_value(), off < 0.7);
  }
}

// Far apart, but the sweep meets both at once.
TEST(TouchingFaces, AreNotThoseBesideEachOther)
{
  const auto xyz = with_points({{6.1, 0, 0}, {12, 0, 0}, {6.1, 6, 0}});
  EXPECT_FALSE(find_touching_faces(xyz, kTwo, kTolerance).has_value());
}

}  // namespace
}  // namespace tessera::surface
