// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/mesh/prism.hpp"

#include <algorithm>
#include <array>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include "tessera/base/vec3.hpp"
#include "tessera/layers/prism_tets.hpp"

namespace tessera::layers {
namespace {

// Corners 0, 1, 2 of a triangle and 3, 4, 5 above them.
constexpr std::array<Vec3, 6> kCorners{
    {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}}};

double volume(const std::vector<LocalIndex>& tets, std::size_t row)
{
  const auto corner = [&](std::size_t c) { return kCorners[at(tets[4 * row + c])]; };
  return tet_volume(corner(0), corner(1), corner(2), corner(3));
}

// The corners of the prism in the order of their names.
Prism named(const std::array<LocalIndex, 3>& order)
{
  return {order[0], order[1], order[2], order[0] + 3, order[1] + 3, order[2] + 3};
}

TEST(PrismTets, ArePositiveAndFillIt)
{
  std::array<LocalIndex, 3> order{0, 1, 2};
  do {
    const bool is_outward = (order[0] + 1) % 3 == order[1];
    std::vector<LocalIndex> tets;
    ASSERT_EQ(append_prism_tets(named(order), is_outward, tets), 3);
    for (std::size_t row = 0; row < 3; ++row) EXPECT_DOUBLE_EQ(volume(tets, row), 1.0 / 6.0);
  } while (std::ranges::next_permutation(order).found);
}

TEST(PrismTets, OfASideHaveTheDiagonalFromItsLowerName)
{
  std::vector<LocalIndex> tets;
  append_prism_tets(named({2, 0, 1}), true, tets);
  std::set<std::array<LocalIndex, 2>> edges;
  for (std::size_t t = 0; t < tets.size(); t += 4) {
    for (std::size_t a = 0; a < 4; ++a) {
      for (std::size_t b = 0; b < 4; ++b) edges.insert({tets[t + a], tets[t + b]});
    }
  }
  EXPECT_TRUE(edges.contains({2, 3}));  // Names are in the order 2, 0, 1.
  EXPECT_TRUE(edges.contains({2, 4}));
  EXPECT_TRUE(edges.contains({0, 4}));
  EXPECT_FALSE(edges.contains({0, 5}));
}

// It leans so far that where one side is finer, half of it would be turned over.
TEST(Prism, MayBePositiveAndHaveHalvesThatAreNot)
{
  using Triangle = std::array<Vec3, 3>;
  const Triangle low{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}};
  const Triangle leaning{{{-0.6, 0.3, 0.5}, {0.8, 0.3, 0.3}, {-0.1, 0.6, 0.4}}};
  EXPECT_TRUE(mesh::is_positive_prism(low, leaning));
  EXPECT_FALSE(mesh::has_positive_parts(low, leaning));
  const Triangle upright{{{0, 0, 1}, {1, 0, 1}, {0, 1, 1}}};
  EXPECT_TRUE(mesh::has_positive_parts(low, upright));
  EXPECT_FALSE(mesh::has_positive_parts(upright, low));
}

TEST(PrismTets, WithoutSomeColumnsAreFewer)
{
  std::vector<LocalIndex> tets;
  EXPECT_EQ(append_prism_tets({0, 1, 2, 0, 4, 5}, true, tets), 2);  // A pyramid.
  EXPECT_EQ(append_prism_tets({0, 1, 2, 0, 1, 5}, true, tets), 1);
  EXPECT_EQ(append_prism_tets({0, 1, 2, 0, 1, 2}, true, tets), 0);
  for (std::size_t row = 0; row < 3; ++row) EXPECT_GT(volume(tets, row), 0.0);
}

TEST(PositivePrism, IsOneThatNoCornerFolds)
{
  const std::array<Vec3, 3> low{kCorners[0], kCorners[1], kCorners[2]};
  const std::array<Vec3, 3> high{kCorners[3], kCorners[4], kCorners[5]};
  EXPECT_TRUE(mesh::is_positive_prism(low, high));
  EXPECT_FALSE(mesh::is_positive_prism(high, low));
  EXPECT_TRUE(mesh::is_positive_prism(low, {kCorners[0], kCorners[4], kCorners[5]}));
  // Columns that cross: the upper triangle is turned over.
  EXPECT_FALSE(mesh::is_positive_prism(low, {kCorners[3], kCorners[5], kCorners[4]}));
}

}  // namespace
}  // namespace tessera::layers
