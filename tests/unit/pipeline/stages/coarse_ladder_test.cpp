// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/stages/coarse/coarse_ladder.hpp"

#include <vector>

#include <gtest/gtest.h>

namespace tessera::pipeline {
namespace {

using Rungs = std::vector<LocalIndex>;

class CoarseLadderTest : public ::testing::Test {
 protected:
  void end(LocalIndex rung, RungEnd how, Rank rank = 0)
  {
    ladder_.ended(rung, to_bytes(how), rank);
  }

  // Whatever idle ranks would get now.
  Rungs all_next()
  {
    Rungs begun;
    while (const auto task = ladder_.next()) begun.push_back(task->item);
    return begun;
  }

  double now_s_ = 0.0;
  CoarseLadder ladder_{5, [this] { return now_s_; }, 3.0};
};

TEST_F(CoarseLadderTest, TheFirstRungHasAHeadStart)
{
  EXPECT_EQ(all_next(), (Rungs{0}));
  now_s_ = 1.0;
  EXPECT_EQ(all_next(), (Rungs{}));
}

TEST_F(CoarseLadderTest, WhatFollowsBeginsInItsOrder)
{
  EXPECT_EQ(all_next(), (Rungs{0}));
  now_s_ = 100.0;
  EXPECT_EQ(all_next(), (Rungs{1, 2, 3, 4}));
}

TEST_F(CoarseLadderTest, AfterAFailureNobodyWaits)
{
  EXPECT_EQ(all_next(), (Rungs{0}));
  end(0, RungEnd::failed);
  EXPECT_EQ(all_next(), (Rungs{1, 2, 3, 4}));
}

TEST_F(CoarseLadderTest, AnEarlierRungWinsThoughALaterOneWasFaster)
{
  static_cast<void>(ladder_.next());
  now_s_ = 100.0;
  static_cast<void>(all_next());
  end(3, RungEnd::surface, 2);
  EXPECT_FALSE(ladder_.is_settled());
  EXPECT_TRUE(ladder_.is_needed(1));
  end(0, RungEnd::surface, 0);
  ASSERT_TRUE(ladder_.is_settled());
  EXPECT_EQ(ladder_.front(), 0);
  EXPECT_TRUE(ladder_.failed().empty());
}

TEST_F(CoarseLadderTest, WhatIsBehindASurfaceIsNotNeeded)
{
  static_cast<void>(ladder_.next());
  now_s_ = 100.0;
  static_cast<void>(all_next());
  end(3, RungEnd::surface, 2);
  EXPECT_FALSE(ladder_.is_needed(4));
}

TEST_F(CoarseLadderTest, ASurfaceThatCannotBeFilledLeadsToTheNextOne)
{
  end(0, RungEnd::failed);
  end(1, RungEnd::surface, 1);
  end(2, RungEnd::surface, 2);
  EXPECT_EQ(ladder_.front(), 1);
  ladder_.fill_has_failed(1);
  EXPECT_EQ(ladder_.front(), 2);
  EXPECT_EQ(ladder_.failed(), (Rungs{0, 1}));
  ladder_.fill_has_failed(2);
  EXPECT_FALSE(ladder_.is_settled());
  EXPECT_EQ(ladder_.next()->item, 3);
}

TEST_F(CoarseLadderTest, AFinalRungCountsOnlyWhenItsTurnHasCome)
{
  static_cast<void>(ladder_.next());
  now_s_ = 100.0;
  static_cast<void>(all_next());
  end(3, RungEnd::final);
  EXPECT_FALSE(ladder_.is_settled());
  for (const LocalIndex before : {0, 1, 2}) end(before, RungEnd::failed);
  EXPECT_TRUE(ladder_.is_settled());
  EXPECT_EQ(ladder_.front(), 3);
}

TEST_F(CoarseLadderTest, AllFailed)
{
  for (LocalIndex rung = 0; rung < 5; ++rung) end(rung, RungEnd::failed);
  EXPECT_TRUE(ladder_.is_settled());
  EXPECT_FALSE(ladder_.front());
  EXPECT_EQ(ladder_.failed().size(), 5U);
}

TEST_F(CoarseLadderTest, WhatWasDroppedIsBegunAgain)
{
  static_cast<void>(ladder_.next());
  ladder_.dropped(0);
  EXPECT_EQ(ladder_.next()->item, 0);
}

TEST_F(CoarseLadderTest, ASnapshotHasEverything)
{
  end(0, RungEnd::failed);
  end(1, RungEnd::surface, 2);
  CoarseLadder other(
      5, [] { return 0.0; }, 3.0);
  other.restore(ladder_.snapshot());
  EXPECT_EQ(other.front(), 1);
  EXPECT_EQ(other.holder(1), 2);
}

}  // namespace
}  // namespace tessera::pipeline
