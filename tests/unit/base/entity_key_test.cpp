// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/base/entity_key.hpp"

#include <cmath>
#include <set>

#include <gtest/gtest.h>

namespace tessera {
namespace {

TEST(KeyOfId, IsTheIdItself)
{
  EXPECT_EQ(key_of_id(0), (VertexKey{0, 0}));
  EXPECT_EQ(key_of_id(GlobalIndex{1} << 40), (VertexKey{std::uint64_t{1} << 40, 0}));
}

TEST(KeyOfPosition, IsThatOfTheBits)
{
  const Vec3 point{1.0, 2.0, 3.0};
  EXPECT_EQ(key_of_position(point), key_of_position(Vec3{1.0, 2.0, 3.0}));
  for (std::size_t axis = 0; axis < 3; ++axis) {
    Vec3 next = point;
    next[axis] = std::nextafter(point[axis], 9.0);
    EXPECT_NE(key_of_position(next), key_of_position(point));
  }
  EXPECT_NE(key_of_position({2.0, 1.0, 3.0}), key_of_position(point));
}

TEST(KeyOfPosition, TakesTheTwoZerosForOne)
{
  EXPECT_EQ(key_of_position({-0.0, 1.0, -0.0}), key_of_position({0.0, 1.0, 0.0}));
  EXPECT_NE(key_of_position({0.0, -1.0, 0.0}), key_of_position({0.0, 1.0, 0.0}));
}

TEST(KeyOfVertices, TellsEdgesAndTrianglesApart)
{
  std::set<EdgeKey> keys;
  for (GlobalIndex a = 0; a < 20; ++a) {
    for (GlobalIndex b = a + 1; b < 20; ++b) {
      keys.insert(key_of_vertices<2>({key_of_id(a), key_of_id(b)}));
      keys.insert(key_of_vertices<3>({key_of_id(a), key_of_id(b), key_of_id(20)}));
    }
  }
  EXPECT_EQ(keys.size(), 2U * 190U);
}

TEST(HashOf, SpreadsIdsInARowOverRanks)
{
  std::array<int, 7> of_rank{};
  for (GlobalIndex id = 0; id < 7000; ++id) ++of_rank[hash_of(key_of_id(id)) % 7];
  for (const int count : of_rank) {
    EXPECT_GT(count, 800);
    EXPECT_LT(count, 1200);
  }
}

}  // namespace
}  // namespace tessera
