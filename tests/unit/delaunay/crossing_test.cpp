// SPDX-License-Identifier: BSD-3-Clause
#include "delaunay/crossing.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace tessera::delaunay {
namespace {

using Triangle = std::array<Vec3, 3>;

// On the corner of a cube. Twelve rows of corners have the same orientation.
constexpr std::array<Vec3, 4> kTet{{{0, 0, 0}, {6, 0, 0}, {0, 6, 0}, {0, 0, 6}}};

struct Sample {
  const char* name;
  Triangle triangle;
  bool is_crossed;
};

std::vector<Sample> samples()
{
  return {
      // No point in common.
      {"Misses", {{{9, 9, 9}, {12, 9, 9}, {9, 12, 9}}}, false},
      {"MissesBesideAnEdge", {{{4, 4, -1}, {4, 4, 7}, {9, 9, 3}}}, false},
      {"MissesInThePlaneOfAFace", {{{7, 7, 0}, {9, 7, 0}, {7, 9, 0}}}, false},
      // A vertex, an edge or a part of the surface in common, in no conflict with it.
      {"HasAVertexOutside", {{{0, 0, 0}, {-3, 0, 1}, {0, -3, 1}}}, false},
      {"HasAVertexInTheFacePlane", {{{0, 0, 0}, {-3, 0, 0}, {0, -3, 0}}}, false},
      {"HasAnEdgeOutside", {{{0, 0, 0}, {6, 0, 0}, {3, -4, -1}}}, false},
      {"HasAnEdgeInTheFacePlane", {{{0, 0, 0}, {6, 0, 0}, {3, -4, 0}}}, false},
      {"SharesAnEdgeAndMakesAKinkInAFacePlane", {{{6, 0, 0}, {0, 6, 0}, {6, 6, 0}}}, false},
      {"TouchesAFaceWithACorner", {{{1, 1, 0}, {0, 1, -5}, {2, 1, -5}}}, false},
      {"TouchesACornerWithASide", {{{5, 5, -5}, {-5, -5, 5}, {-9, -9, -9}}}, false},
      {"HasASideBesideACornerInTheFacePlane", {{{-9, 8, 0}, {8, -9, 0}, {-9, -9, 0}}}, false},
      // Through the inside.
      {"HasAVertexAndGoesThrough", {{{0, 0, 0}, {6, 6, 1}, {6, 1, 6}}}, true},
      {"HasAnEdgeAndGoesThrough", {{{0, 0, 0}, {6, 0, 0}, {3, 6, 6}}}, true},
      {"HasAnEdgeAndEndsInside", {{{0, 0, 0}, {6, 0, 0}, {1, 1, 1}}}, true},
      {"HasAnEdgeAndEndsOnAFace", {{{0, 0, 0}, {6, 0, 0}, {2, 2, 2}}}, true},
      {"CutsAllEdgesAtACorner", {{{-9, -9, 1}, {18, -9, 1}, {-9, 18, 1}}}, true},
      {"CutsTwoPairsOfEdges", {{{3, 3, -20}, {-20, 1, 3}, {20, 2, 20}}}, true},
      {"LiesInside", {{{1, 1, 1}, {2, 1, 1}, {1, 2, 1}}}, true},
      {"PiercesWithACorner", {{{1, 1, 1}, {-9, -9, 1}, {-9, -8, 2}}}, true},
      {"IsPiercedByAnEdgeOfTheTet", {{{3, -1, -1}, {3, 1, -1}, {3, 0, 9}}}, true},
      // In the plane of a face, and another triangle.
      {"OverlapsAFace", {{{-1, -1, 0}, {3, 1, 0}, {1, 3, 0}}}, true},
      {"LiesInAFace", {{{1, 1, 0}, {2, 1, 0}, {1, 2, 0}}}, true},
      {"HoldsAFace", {{{-9, -9, 0}, {30, -9, 0}, {-9, 30, 0}}}, true},
      {"HasAnEdgeAndOverlapsAFace", {{{0, 0, 0}, {6, 0, 0}, {6, 6, 0}}}, true},
      {"HasAnEdgeAndLiesInAFace", {{{0, 0, 0}, {6, 0, 0}, {1, 1, 0}}}, true},
      {"HasAVertexAndOverlapsAFace", {{{0, 0, 0}, {6, 3, 0}, {3, 6, 0}}}, true},
  };
}

Vec3 permuted(const Vec3& p, const std::array<std::size_t, 3>& axes)
{
  return {p[axes[0]], p[axes[1]], p[axes[2]]};
}

// In all orders of corners, along all axes, moved and doubled: whole numbers stay whole.
class IsCrossed : public ::testing::TestWithParam<Sample> {
 protected:
  template <class Check>
  static void for_all_orders(std::array<Vec3, 4> tet, Triangle triangle, Check check)
  {
    std::array<std::size_t, 4> order{0, 1, 2, 3};
    do {
      const std::array<Vec3, 4> turned{tet[order[0]], tet[order[1]], tet[order[2]], tet[order[3]]};
      if (tet_volume(turned[0], turned[1], turned[2], turned[3]) < 0.0) continue;
      std::array<std::size_t, 3> corners{0, 1, 2};
      do {
        check(turned, {triangle[corners[0]], triangle[corners[1]], triangle[corners[2]]});
      } while (std::ranges::next_permutation(corners).found);
    } while (std::ranges::next_permutation(order).found);
  }
};

TEST_P(IsCrossed, InAllOrdersOfCornersAndAxes)
{
  const Sample& sample = GetParam();
  std::array<std::size_t, 3> axes{0, 1, 2};
  int num_checked = 0;
  do {
    std::array<Vec3, 4> tet{};
    Triangle triangle{};
    const Vec3 offset{-3, 5, 40};
    std::ranges::transform(kTet, tet.begin(),
                           [&](const Vec3& p) { return 2.0 * permuted(p, axes) + offset; });
    std::ranges::transform(sample.triangle, triangle.begin(),
                           [&](const Vec3& p) { return 2.0 * permuted(p, axes) + offset; });
    for_all_orders(tet, triangle, [&](const auto& turned, const Triangle& given) {
      EXPECT_EQ(is_crossed(turned, given), sample.is_crossed);
      ++num_checked;
    });
  } while (std::ranges::next_permutation(axes).found);
  EXPECT_EQ(num_checked, 6 * 12 * 6);
}

INSTANTIATE_TEST_SUITE_P(Triangles, IsCrossed, ::testing::ValuesIn(samples()),
                         [](const auto& of) { return std::string(of.param.name); });

// A triangle that misses or hits by the last bit.
TEST(IsCrossedExactly, ByTheLastBit)
{
  constexpr double kBit = 0x1p-52;
  const auto beside = [](double z) { return Triangle{{{0, 0, 0}, {6, 0, 0}, {3, 4, z}}}; };
  EXPECT_FALSE(is_crossed(kTet, beside(-kBit)));
  EXPECT_TRUE(is_crossed(kTet, beside(kBit)));
  EXPECT_TRUE(is_crossed(kTet, beside(0.0)));
}

}  // namespace
}  // namespace tessera::delaunay
