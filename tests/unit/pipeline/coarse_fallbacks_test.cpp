// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

#include "pipeline/stages/coarse_plans.hpp"

namespace tessera::pipeline {
namespace {

using coarse::CoarseOptions;
using coarse::SurfaceMesher;

CoarseOptions asked()
{
  CoarseOptions options;
  options.max_size = 10.0;
  options.feature_angle_deg = 25.0;
  options.timeout_s = 7.0;
  return options;
}

bool is_netgen(const CoarseOptions& options)
{
  return options.surface_mesher == SurfaceMesher::netgen;
}

TEST(CoarseFallbacks, BeginWithWhatWasAskedFor)
{
  EXPECT_EQ(coarse_fallbacks(asked()).front(), asked());
}

TEST(CoarseFallbacks, NoneIsTriedTwice)
{
  const std::vector<CoarseOptions> fallbacks = coarse_fallbacks(asked());
  ASSERT_GT(fallbacks.size(), 1U);
  for (auto one = fallbacks.begin(); one != fallbacks.end(); ++one) {
    EXPECT_EQ(std::find(one + 1, fallbacks.end(), *one), fallbacks.end());
  }
}

TEST(CoarseFallbacks, NoneIsCoarserOrGivesUpAnotherWish)
{
  for (const CoarseOptions& one : coarse_fallbacks(asked())) {
    EXPECT_GT(one.max_size, 0.0);
    EXPECT_LE(one.max_size, asked().max_size);
    EXPECT_LE(one.grading, asked().grading);
    EXPECT_GE(one.curvature, asked().curvature);
    EXPECT_EQ(one.feature_angle_deg, asked().feature_angle_deg);
    EXPECT_EQ(one.timeout_s, asked().timeout_s);
  }
}

TEST(CoarseFallbacks, SmallerSizesOfNetgenGrowMoreSlowly)
{
  int num_smaller = 0;
  for (const CoarseOptions& one : coarse_fallbacks(asked())) {
    if (!is_netgen(one) || one.max_size == asked().max_size) continue;
    ++num_smaller;
    EXPECT_LT(one.grading, asked().grading);
  }
  EXPECT_EQ(num_smaller, 2);
}

TEST(CoarseFallbacks, ASlowGrowthThatWasAskedForStays)
{
  CoarseOptions slow = asked();
  slow.grading = 0.1;
  for (const CoarseOptions& one : coarse_fallbacks(slow)) EXPECT_EQ(one.grading, 0.1);
}

TEST(CoarseFallbacks, OneHasMoreElementsOnCurvedSurfaces)
{
  const std::vector<CoarseOptions> fallbacks = coarse_fallbacks(asked());
  const auto is_rounder = [](const CoarseOptions& one) {
    return one.curvature > asked().curvature;
  };
  EXPECT_EQ(std::ranges::count_if(fallbacks, is_rounder), 1);
}

TEST(CoarseFallbacks, TrianglesOfTheModelComeAfterOtherSizes)
{
  const std::vector<CoarseOptions> fallbacks = coarse_fallbacks(asked());
  EXPECT_EQ(std::ranges::count_if(fallbacks, is_netgen), 4);
  ASSERT_EQ(fallbacks.size(), 6U);
  EXPECT_FALSE(is_netgen(fallbacks[3]));
  EXPECT_EQ(fallbacks[3].max_size, asked().max_size);
  EXPECT_FALSE(is_netgen(fallbacks[5]));
  EXPECT_LT(fallbacks[5].max_size, asked().max_size);
}

TEST(CoarseFallbacks, ManyMoreTetsComeAfterTrianglesOfTheModel)
{
  const std::vector<CoarseOptions> fallbacks = coarse_fallbacks(asked());
  EXPECT_EQ(fallbacks.at(4).curvature, 2.0 * asked().curvature);
}

}  // namespace
}  // namespace tessera::pipeline
