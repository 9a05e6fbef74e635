// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/base/morton_order.hpp"

#include <vector>

#include <gtest/gtest.h>

namespace tessera {
namespace {

TEST(MortonOrder, GoesThroughTheCornersOfACubeByBits)
{
  std::vector<double> xyz;
  std::vector<LocalIndex> wanted;
  for (LocalIndex corner = 0; corner < 8; ++corner) {
    const LocalIndex reversed = 7 - corner;  // So that the rows are not in order already.
    xyz.insert(xyz.end(), {1.0 * (reversed & 1), 1.0 * (reversed >> 1 & 1), 1.0 * (reversed >> 2)});
    wanted.push_back(reversed);
  }
  EXPECT_EQ(morton_order(xyz), wanted);
}

TEST(MortonOrder, KeepsRowsOfOneCellInOrderAndIgnoresWhatElseARowHas)
{
  EXPECT_EQ(morton_order(std::vector<double>{1, 1, 1, 9, 0, 0, 0, 7, 1, 1, 1, 8}, 4),
            (std::vector<LocalIndex>{1, 0, 2}));
  EXPECT_EQ(morton_order(std::vector<double>{3, 3, 3, 3, 3, 3}), (std::vector<LocalIndex>{0, 1}));
  EXPECT_TRUE(morton_order({}).empty());
}

}  // namespace
}  // namespace tessera
