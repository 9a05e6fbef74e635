// SPDX-License-Identifier: BSD-3-Clause
#include "subdomain/refine/piece_schedule.hpp"

#include <algorithm>

#include <gtest/gtest.h>

namespace tessera::subdomain {
namespace {

using optimize::Step;

std::ptrdiff_t count(const optimize::Schedule& schedule, Step step)
{
  return std::ranges::count(schedule.steps, step);
}

TEST(PieceSchedule, DividesOnceBehindTheFirstSwapsOrNotAtAll)
{
  const optimize::Schedule schedule = piece_schedule(true);
  const auto divide = std::ranges::find(schedule.steps, Step::divide);
  ASSERT_NE(divide, schedule.steps.end());
  EXPECT_EQ(count(schedule, Step::divide), 1);
  EXPECT_EQ(count(piece_schedule(true, 3), Step::divide), 1);
  EXPECT_GT(std::count(schedule.steps.begin(), divide, Step::swap), 0);
  EXPECT_GT(std::count(divide, schedule.steps.end(), Step::insert), 0);
  EXPECT_EQ(count(piece_schedule(false), Step::divide), 0);
}

TEST(PieceSchedule, EveryRoundHasAllSteps)
{
  const auto once = piece_schedule(false, 1).steps.size();
  const auto twice = piece_schedule(false, 2).steps.size();
  EXPECT_EQ(piece_schedule(false, 3).steps.size() - twice, twice - once);
  EXPECT_GT(twice, once);
}

TEST(PieceSchedule, EndsWithTheWorstTets)
{
  for (const bool divides : {false, true}) {
    EXPECT_EQ(piece_schedule(divides).steps.back(), Step::smooth_worst);
  }
}

}  // namespace
}  // namespace tessera::subdomain
