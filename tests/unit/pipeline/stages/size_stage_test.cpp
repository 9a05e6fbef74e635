// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/stages/model/size_stage.hpp"

#include <limits>
#include <numbers>

#include <gtest/gtest.h>

namespace tessera::pipeline {
namespace {

TEST(LevelsFor, GrowWithTheNumberOfTets)
{
  EXPECT_EQ(levels_for(0.0), 1);
  EXPECT_EQ(levels_for(499'999.0), 1);
  EXPECT_EQ(levels_for(500'000.0), 2);
  EXPECT_EQ(levels_for(3'999'999.0), 2);
  EXPECT_EQ(levels_for(4'000'000.0), 3);
  EXPECT_EQ(levels_for(99'999'999.0), 3);
  EXPECT_EQ(levels_for(1e8), 4);
  EXPECT_EQ(levels_for(std::numeric_limits<double>::infinity()), 4);
}

TEST(EstimatedTets, AreThoseOfRegularOnesInTheVolume)
{
  EXPECT_NEAR(estimated_tets(2.0, 1.0), 2.0 / (std::numbers::sqrt2 / 12.0), 1e-12);
  EXPECT_NEAR(estimated_tets(2.0, 0.5), 8.0 * estimated_tets(2.0, 1.0), 1e-12);
}

}  // namespace
}  // namespace tessera::pipeline
