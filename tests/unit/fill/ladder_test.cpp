// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/fill/ladder.hpp"

#include <set>

#include <gtest/gtest.h>

namespace tessera::fill {
namespace {

TEST(RetryLadder, BeginsAsAsked)
{
  const auto ladder = retry_ladder({.optimize_steps = 5, .grading = 0.2});
  ASSERT_FALSE(ladder.empty());
  EXPECT_EQ(ladder[0].grading, 0.2);
  EXPECT_EQ(ladder[0].optimize_steps, 5);
  EXPECT_EQ(ladder[0].point_order_seed, 0U);
}

TEST(RetryLadder, FirstChangesOnlyTheOrderOfPoints)
{
  const auto ladder = retry_ladder({});
  ASSERT_GE(ladder.size(), 2U);
  EXPECT_EQ(ladder[1].grading, ladder[0].grading);
  EXPECT_EQ(ladder[1].optimize_steps, ladder[0].optimize_steps);
  EXPECT_NE(ladder[1].point_order_seed, 0U);
}

TEST(RetryLadder, TriesNothingTwiceAndStaysInRange)
{
  for (const double grading : {0.01, 0.3, 0.7, 1.0}) {
    for (const int steps : {0, 1, 3}) {
      std::set<unsigned> seeds;
      for (const FillTry& rung : retry_ladder({.optimize_steps = steps, .grading = grading})) {
        EXPECT_TRUE(seeds.insert(rung.point_order_seed).second);
        EXPECT_GE(rung.grading, grading);
        EXPECT_LE(rung.grading, 1.0);
        EXPECT_GE(rung.optimize_steps, 0);
        EXPECT_LE(rung.optimize_steps, steps);
      }
    }
  }
}

}  // namespace
}  // namespace tessera::fill
