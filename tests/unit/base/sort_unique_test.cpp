// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/base/sort_unique.hpp"

#include <gtest/gtest.h>

namespace tessera {
namespace {

std::vector<int> sorted(std::vector<int> values)
{
  sort_unique(values);
  return values;
}

TEST(SortUnique, LeavesEachValueOnceAscending)
{
  EXPECT_EQ(sorted({3, -1, 3, 2, -1, 3}), (std::vector<int>{-1, 2, 3}));
  EXPECT_EQ(sorted({5, 5, 5}), std::vector<int>{5});
  EXPECT_EQ(sorted({1}), std::vector<int>{1});
  EXPECT_EQ(sorted({}), std::vector<int>());
}

}  // namespace
}  // namespace tessera
