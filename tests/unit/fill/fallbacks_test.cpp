// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/fill/fallbacks.hpp"

#include <algorithm>
#include <set>
#include <string>
#include <utility>

#include <gtest/gtest.h>

#include "tessera/base/error.hpp"

namespace tessera::fill {
namespace {

TEST(FallbackSequence, BeginsAsAsked)
{
  const auto fallbacks =
      fallback_sequence({.optimize_steps = 5, .grading = 0.2}, KernelKind::netgen);
  ASSERT_FALSE(fallbacks.empty());
  EXPECT_EQ(fallbacks[0].settings.grading, 0.2);
  EXPECT_EQ(fallbacks[0].settings.optimize_steps, 5);
  EXPECT_EQ(fallbacks[0].settings.point_order_seed, 0U);
}

TEST(FallbackSequence, SplitsCornersInAllTriesOrInNone)
{
  for (const KernelKind kernel :
       {KernelKind::netgen, KernelKind::optimize, KernelKind::subdivide}) {
    for (const bool split : {false, true}) {
      const auto fallbacks = fallback_sequence({.split_corners = split}, kernel);
      EXPECT_FALSE(fallbacks.empty());
      for (const FillTry& fallback : fallbacks) EXPECT_EQ(fallback.split_corners, split);
    }
  }
}

TEST(FallbackSequence, SplitsCornersByItselfWhereTheFillIsNotKnownBefore)
{
  for (const auto& [kernel, splits] : {std::pair{KernelKind::netgen, true},
                                       {KernelKind::optimize, true},
                                       {KernelKind::subdivide, false}}) {
    EXPECT_EQ(splits_corners({}, kernel), splits);
    const auto fallbacks = fallback_sequence({}, kernel);
    EXPECT_FALSE(fallbacks.empty());
    for (const FillTry& fallback : fallbacks) EXPECT_EQ(fallback.split_corners, splits);
  }
}

TEST(FallbackSequence, ThenChangesOnlyTheStartThenOnlyTheOrderOfPoints)
{
  const auto fallbacks = fallback_sequence({}, KernelKind::netgen);
  ASSERT_GE(fallbacks.size(), 3U);
  EXPECT_EQ(fallbacks[0].start, FillStart::children);
  for (const std::size_t fallback : {1U, 2U}) {
    EXPECT_EQ(fallbacks[fallback].start, FillStart::skin);
    EXPECT_EQ(fallbacks[fallback].settings.grading, fallbacks[0].settings.grading);
    EXPECT_EQ(fallbacks[fallback].settings.optimize_steps, fallbacks[0].settings.optimize_steps);
  }
  EXPECT_EQ(fallbacks[1].settings.point_order_seed, fallbacks[0].settings.point_order_seed);
  EXPECT_NE(fallbacks[2].settings.point_order_seed, fallbacks[0].settings.point_order_seed);
}

TEST(FallbackSequence, TriesNothingTwiceAndStaysInRange)
{
  for (const double grading : {0.01, 0.3, 0.7, 1.0}) {
    for (const int steps : {0, 1, 3}) {
      std::set<std::pair<FillStart, unsigned>> begun;
      for (const FillTry& fallback :
           fallback_sequence({.optimize_steps = steps, .grading = grading}, KernelKind::netgen)) {
        if (fallback.kernel != KernelKind::netgen) continue;
        EXPECT_TRUE(begun.insert({fallback.start, fallback.settings.point_order_seed}).second);
        EXPECT_GE(fallback.settings.grading, grading);
        EXPECT_LE(fallback.settings.grading, 1.0);
        EXPECT_GE(fallback.settings.optimize_steps, 0);
        EXPECT_LE(fallback.settings.optimize_steps, steps);
      }
      EXPECT_GT(begun.size(), 1U);
    }
  }
}

TEST(FallbackSequence, EndsWithSubdivisionAndNothingElseDoesBeforeIt)
{
  const auto fallbacks = fallback_sequence({}, KernelKind::netgen);
  EXPECT_EQ(fallbacks.back().kernel, KernelKind::subdivide);
  EXPECT_EQ(std::ranges::count(fallbacks, KernelKind::subdivide, &FillTry::kernel), 1);
  const auto only = fallback_sequence({}, KernelKind::subdivide);
  ASSERT_EQ(only.size(), 1U);
  EXPECT_EQ(only.front().kernel, KernelKind::subdivide);
}

TEST(KernelsOf, FollowTheRegionOfTheMaterial)
{
  FillOptions options;
  options.regions = {{"core", KernelKind::subdivide}};
  const auto kernels = kernels_of(options, {"shell", "core"}, std::vector{1, 2, 2, 1});
  EXPECT_EQ(kernels, (std::vector{KernelKind::netgen, KernelKind::subdivide, KernelKind::subdivide,
                                  KernelKind::netgen}));
}

TEST(KernelsOf, ARegionIsOfAllMaterialsWithItsName)
{
  FillOptions options;
  options.regions = {{"core", KernelKind::subdivide}};
  EXPECT_EQ(kernels_of(options, {"core", "shell", "core"}, std::vector{1, 2, 3}),
            (std::vector{KernelKind::subdivide, KernelKind::netgen, KernelKind::subdivide}));
}

TEST(KernelsOf, AnUnknownMaterialIsRefusedWithTheKnownOnes)
{
  FillOptions options;
  options.regions = {{"cor", KernelKind::subdivide}};
  try {
    static_cast<void>(kernels_of(options, {"shell", "core"}, std::vector{1}));
    FAIL() << "a region of no material was taken";
  } catch (const ConfigError& error) {
    EXPECT_NE(std::string(error.what()).find("\"cor\""), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("\"core\""), std::string::npos);
  }
}

TEST(FallbackSequence, OfOurOptimiserEndsWithSubdivisionToo)
{
  const auto fallbacks = fallback_sequence({}, KernelKind::optimize);
  ASSERT_EQ(fallbacks.size(), 2U);
  EXPECT_EQ(fallbacks[0].kernel, KernelKind::optimize);
  EXPECT_EQ(fallbacks[1].kernel, KernelKind::subdivide);
}

}  // namespace
}  // namespace tessera::fill
