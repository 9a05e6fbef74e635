// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/base/index_lists.hpp"

#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace tessera {
namespace {

std::vector<std::vector<LocalIndex>> nested(const IndexLists& lists)
{
  std::vector<std::vector<LocalIndex>> result;
  for (LocalIndex i = 0; i < lists.num_lists(); ++i) {
    result.emplace_back(lists[i].begin(), lists[i].end());
  }
  return result;
}

TEST(Lists, AreNoneAtFirst)
{
  const IndexLists lists;
  EXPECT_EQ(lists.num_lists(), 0);
  EXPECT_TRUE(lists.values.empty());
}

TEST(Lists, KeepTheOrderInWhichTheyWereMade)
{
  Lists<std::string> lists;
  lists.add(std::vector<std::string>{"a", "b"});
  lists.add({});
  lists.values.emplace_back("c");
  lists.end_list();
  ASSERT_EQ(lists.num_lists(), 3);
  EXPECT_EQ(lists[0].size(), 2U);
  EXPECT_EQ(lists[0][1], "b");
  EXPECT_TRUE(lists[1].empty());
  ASSERT_EQ(lists[2].size(), 1U);
  EXPECT_EQ(lists[2][0], "c");
}

TEST(RowsByKey, ListsTheRowsOfEachKeyAscending)
{
  const std::vector<LocalIndex> keys{2, 0, 2, kNoIndex, 0, 2};
  EXPECT_EQ(nested(rows_by_key(keys, 4)),
            (std::vector<std::vector<LocalIndex>>{{1, 4}, {}, {0, 2, 5}, {}}));
}

TEST(RowsByKey, NamesARowOnceForEachOfItsKeys)
{
  const std::vector<LocalIndex> keys{0, 1, 1, kNoIndex, kNoIndex, 0, 1, 1};  // Four rows of two.
  EXPECT_EQ(nested(rows_by_key(keys, 2, 2)),
            (std::vector<std::vector<LocalIndex>>{{0, 2}, {0, 1, 3, 3}}));
}

TEST(RowsByKey, OfNothingAreEmptyLists)
{
  EXPECT_EQ(nested(rows_by_key({}, 2)), (std::vector<std::vector<LocalIndex>>{{}, {}}));
  EXPECT_EQ(rows_by_key({}, 0), IndexLists{});
}

TEST(Inverted, ListsWhoHoldsEachValue)
{
  IndexLists lists;
  lists.add(std::vector<LocalIndex>{3, 1});
  lists.add({});
  lists.add(std::vector<LocalIndex>{1});
  EXPECT_EQ(nested(inverted(lists, 5)),
            (std::vector<std::vector<LocalIndex>>{{}, {0, 2}, {}, {0}, {}}));
  EXPECT_EQ(inverted(IndexLists{}, 0), IndexLists{});
}

TEST(Inverted, TwiceGivesSortedListsBack)
{
  IndexLists lists;
  lists.add(std::vector<LocalIndex>{0, 2, 3});
  lists.add(std::vector<LocalIndex>{2});
  lists.add({});
  lists.add(std::vector<LocalIndex>{1, 3});
  EXPECT_EQ(inverted(inverted(lists, 4), lists.num_lists()), lists);
}

}  // namespace
}  // namespace tessera
