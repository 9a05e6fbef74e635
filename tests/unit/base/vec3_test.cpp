// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/base/vec3.hpp"

#include <vector>

#include <gtest/gtest.h>

namespace tessera {
namespace {

TEST(Vec3, CrossProductIsRightHandedAndUpright)
{
  EXPECT_EQ(cross({1, 0, 0}, {0, 1, 0}), (Vec3{0, 0, 1}));
  EXPECT_EQ(cross({0, 1, 0}, {0, 0, 1}), (Vec3{1, 0, 0}));
  const Vec3 a{1, -2, 3};
  const Vec3 b{4, 0.5, -1};
  EXPECT_EQ(dot(cross(a, b), a), 0.0);
  EXPECT_EQ(dot(cross(a, b), b), 0.0);
  EXPECT_EQ(cross(a, b), -1.0 * cross(b, a));
}

TEST(Vec3, TetVolumeIsPositiveInVtksOrder)
{
  const Vec3 o{0, 0, 0}, x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
  EXPECT_DOUBLE_EQ(tet_volume(o, x, y, z), 1.0 / 6.0);
  EXPECT_DOUBLE_EQ(tet_volume(o, y, x, z), -1.0 / 6.0);
  EXPECT_DOUBLE_EQ(tet_volume(x, y, o, z), 1.0 / 6.0);  // Even permutation.
  EXPECT_EQ(tet_volume(o, x, y, {1, 1, 0}), 0.0);
}

// Both sides of a seam compute a midpoint, each with its own idea of which end is first.
TEST(Vec3, MidpointIsTheSameBitsFromBothEnds)
{
  const Vec3 a{0.1, 1e300, -3.7};
  const Vec3 b{0.7, 1e-300, 1.3};
  EXPECT_EQ(midpoint(a, b), midpoint(b, a));
  EXPECT_EQ(midpoint({1, 2, 3}, {3, 2, 1}), (Vec3{2, 2, 2}));
}

TEST(Vec3, PointAtReadsRows)
{
  const std::vector<double> xyz{1, 2, 3, 4, 5, 6};
  EXPECT_EQ(point_at(std::span(xyz), 1), (Vec3{4, 5, 6}));
  EXPECT_EQ(norm(Vec3{3, 0, 4}), 5.0);
}

}  // namespace
}  // namespace tessera
