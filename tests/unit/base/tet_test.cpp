// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/base/tet.hpp"

#include <array>
#include <vector>

#include <gtest/gtest.h>

namespace tessera {
namespace {

const std::vector<double> kXyz{9.0, 9.0, 9.0, 0.0, 0.0, 0.0, 4.0, 0.0,
                               0.0, 0.0, 4.0, 0.0, 0.0, 0.0, 8.0};

TEST(Tet, HasTheCornersOfItsRow)
{
  const std::vector<LocalIndex> tets{0, 0, 0, 0, 1, 2, 3, 4};
  const std::array<Vec3, 4> corners = corners_at<4>(kXyz, tets, 1);
  EXPECT_EQ(corners[0], Vec3{});
  EXPECT_EQ(corners[1], (Vec3{4.0, 0.0, 0.0}));
  EXPECT_EQ(corners[2], (Vec3{0.0, 4.0, 0.0}));
  EXPECT_EQ(corners[3], (Vec3{0.0, 0.0, 8.0}));
}

TEST(Tet, OfATriangleThereAreThreeCorners)
{
  const std::vector<LocalIndex> triangles{0, 0, 0, 4, 3, 2};
  const std::array<Vec3, 3> corners = corners_at<3>(kXyz, triangles, std::size_t{1});
  EXPECT_EQ(corners[0], (Vec3{0.0, 0.0, 8.0}));
  EXPECT_EQ(corners[2], (Vec3{4.0, 0.0, 0.0}));
}

TEST(Tet, HasAVolumeWithASignAndACentroid)
{
  const std::array<Vec3, 4> corners = corners_at<4>(kXyz, std::array<LocalIndex, 4>{1, 2, 3, 4}, 0);
  EXPECT_DOUBLE_EQ(tet_volume(corners), 128.0 / 6.0);
  EXPECT_DOUBLE_EQ(tet_volume({corners[0], corners[2], corners[1], corners[3]}), -128.0 / 6.0);
  EXPECT_EQ(tet_centroid(corners), (Vec3{1.0, 1.0, 2.0}));
}

}  // namespace
}  // namespace tessera
