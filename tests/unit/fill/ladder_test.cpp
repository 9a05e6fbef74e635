// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/fill/ladder.hpp"

#include <algorithm>
#include <set>
#include <string>
#include <utility>

#include <gtest/gtest.h>

#include "tessera/base/error.hpp"

namespace tessera::fill {
namespace {

TEST(RetryLadder, BeginsAsAsked)
{
  const auto ladder = retry_ladder({.optimize_steps = 5, .grading = 0.2}, KernelKind::netgen);
  ASSERT_FALSE(ladder.empty());
  EXPECT_EQ(ladder[0].grading, 0.2);
  EXPECT_EQ(ladder[0].optimize_steps, 5);
  EXPECT_EQ(ladder[0].point_order_seed, 0U);
}

TEST(RetryLadder, ThenChangesOnlyTheStartThenOnlyTheOrderOfPoints)
{
  const auto ladder = retry_ladder({}, KernelKind::netgen);
  ASSERT_GE(ladder.size(), 3U);
  EXPECT_EQ(ladder[0].start, FillStart::children);
  for (const std::size_t rung : {1U, 2U}) {
    EXPECT_EQ(ladder[rung].start, FillStart::skin);
    EXPECT_EQ(ladder[rung].grading, ladder[0].grading);
    EXPECT_EQ(ladder[rung].optimize_steps, ladder[0].optimize_steps);
  }
  EXPECT_EQ(ladder[1].point_order_seed, ladder[0].point_order_seed);
  EXPECT_NE(ladder[2].point_order_seed, ladder[0].point_order_seed);
}

TEST(RetryLadder, TriesNothingTwiceAndStaysInRange)
{
  for (const double grading : {0.01, 0.3, 0.7, 1.0}) {
    for (const int steps : {0, 1, 3}) {
      std::set<std::pair<FillStart, unsigned>> begun;
      for (const FillTry& rung :
           retry_ladder({.optimize_steps = steps, .grading = grading}, KernelKind::netgen)) {
        if (rung.kernel != KernelKind::netgen) continue;
        EXPECT_TRUE(begun.insert({rung.start, rung.point_order_seed}).second);
        EXPECT_GE(rung.grading, grading);
        EXPECT_LE(rung.grading, 1.0);
        EXPECT_GE(rung.optimize_steps, 0);
        EXPECT_LE(rung.optimize_steps, steps);
      }
    }
  }
}

TEST(RetryLadder, EndsWithSubdivisionAndNothingElseDoesBeforeIt)
{
  const auto ladder = retry_ladder({}, KernelKind::netgen);
  EXPECT_EQ(ladder.back().kernel, KernelKind::subdivide);
  EXPECT_EQ(std::ranges::count(ladder, KernelKind::subdivide, &FillTry::kernel), 1);
  const auto only = retry_ladder({}, KernelKind::subdivide);
  ASSERT_EQ(only.size(), 1U);
  EXPECT_EQ(only.front().kernel, KernelKind::subdivide);
}

TEST(KernelsOf, FollowTheRegionOfTheMaterial)
{
  FillOptions options;
  options.regions = {{"core", KernelKind::subdivide}};
  const auto kernels = kernels_of(options, {"shell", "core"}, {1, 2, 2, 1});
  EXPECT_EQ(kernels, (std::vector{KernelKind::netgen, KernelKind::subdivide, KernelKind::subdivide,
                                  KernelKind::netgen}));
}

TEST(KernelsOf, AnUnknownMaterialIsRefusedWithTheKnownOnes)
{
  FillOptions options;
  options.regions = {{"cor", KernelKind::subdivide}};
  try {
    static_cast<void>(kernels_of(options, {"shell", "core"}, {1}));
    FAIL() << "a region of no material was taken";
  } catch (const ConfigError& error) {
    EXPECT_NE(std::string(error.what()).find("\"cor\""), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("\"core\""), std::string::npos);
  }
}

}  // namespace
}  // namespace tessera::fill
