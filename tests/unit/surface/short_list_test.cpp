// SPDX-License-Identifier: BSD-3-Clause
#include "surface/short_list.hpp"

#include <vector>

#include <gtest/gtest.h>

namespace tessera::surface {
namespace {

std::vector<LocalIndex> values_of(const ShortList& list)
{
  return {list.values().begin(), list.values().end()};
}

TEST(ShortList, KeepsTheOrderHoweverLongItIs)
{
  constexpr LocalIndex kMost = 30;
  ShortList list;
  std::vector<LocalIndex> expected;
  EXPECT_TRUE(list.is_empty());
  for (LocalIndex i = 0; i < kMost; ++i) {
    list.add(3 * i);
    expected.push_back(3 * i);
    EXPECT_EQ(values_of(list), expected);
  }
  // From the middle to both ends.
  while (!expected.empty()) {
    const auto middle = expected.begin() + static_cast<std::ptrdiff_t>(expected.size() / 2);
    list.remove(*middle);
    expected.erase(middle);
    EXPECT_EQ(values_of(list), expected);
  }
  EXPECT_TRUE(list.is_empty());
}

TEST(ShortList, GrowsAgainAfterItWasLong)
{
  ShortList list;
  for (LocalIndex i = 0; i < 12; ++i) list.add(i);
  for (LocalIndex i = 0; i < 8; ++i) list.remove(i);
  for (LocalIndex i = 20; i < 28; ++i) list.add(i);
  EXPECT_EQ(values_of(list),
            (std::vector<LocalIndex>{8, 9, 10, 11, 20, 21, 22, 23, 24, 25, 26, 27}));
}

}  // namespace
}  // namespace tessera::surface
