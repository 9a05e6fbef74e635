// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/base/union_find.hpp"

#include <vector>

#include <gtest/gtest.h>

namespace tessera {
namespace {

std::vector<LocalIndex> roots_of(UnionFind& sets, LocalIndex n)
{
  std::vector<LocalIndex> roots;
  for (LocalIndex i = 0; i < n; ++i) roots.push_back(sets.find(i));
  return roots;
}

TEST(UnionFind, LetsTheLowestMemberStandForItsSet)
{
  UnionFind sets(6);
  EXPECT_TRUE(sets.join(5, 4));
  EXPECT_TRUE(sets.join(2, 3));
  EXPECT_TRUE(sets.join(3, 5));
  EXPECT_EQ(roots_of(sets, 6), (std::vector<LocalIndex>{0, 1, 2, 2, 2, 2}));
  EXPECT_FALSE(sets.join(4, 2));
  EXPECT_TRUE(sets.join(4, 0));
  EXPECT_EQ(roots_of(sets, 6), (std::vector<LocalIndex>{0, 1, 0, 0, 0, 0}));
}

// Of every order of joins: the chain is the worst for depth, and the root stays the lowest.
TEST(UnionFind, FindsTheEndOfALongChain)
{
  constexpr LocalIndex kLength = 10'000;
  UnionFind sets(kLength);
  for (LocalIndex i = kLength - 1; i > 0; --i) EXPECT_TRUE(sets.join(i, i - 1));
  EXPECT_EQ(roots_of(sets, kLength), std::vector<LocalIndex>(kLength, 0));
}

TEST(UnionFind, GrowsByOneAtATime)
{
  UnionFind sets;
  EXPECT_EQ(sets.add(), 0);
  EXPECT_EQ(sets.add(), 1);
  EXPECT_TRUE(sets.join(0, 1));
  EXPECT_EQ(sets.add(), 2);
  EXPECT_EQ(roots_of(sets, 3), (std::vector<LocalIndex>{0, 0, 2}));
  sets.clear();
  EXPECT_EQ(sets.add(), 0);
  EXPECT_EQ(sets.add(), 1);
  EXPECT_EQ(roots_of(sets, 2), (std::vector<LocalIndex>{0, 1}));
}

TEST(UnionFind, SeparatesWholeSetsAgain)
{
  UnionFind sets(5);
  sets.join(0, 1);
  sets.join(2, 3);
  sets.join(3, 4);
  sets.separate(std::vector<LocalIndex>{4, 2, 3});
  EXPECT_EQ(roots_of(sets, 5), (std::vector<LocalIndex>{0, 0, 2, 3, 4}));
}

}  // namespace
}  // namespace tessera
