// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/stages/size_stage.hpp"

#include <limits>

#include <gtest/gtest.h>

namespace tessera::pipeline {
namespace {

TEST(LevelsFor, GrowWithTheNumberOfTets)
{
  EXPECT_EQ(levels_for(0.0), 1);
  EXPECT_EQ(levels_for(19'999.0), 1);
  EXPECT_EQ(levels_for(20'000.0), 2);
  EXPECT_EQ(levels_for(1'999'999.0), 2);
  EXPECT_EQ(levels_for(2'000'000.0), 3);
  EXPECT_EQ(levels_for(99'999'999.0), 3);
  EXPECT_EQ(levels_for(1e8), 4);
  EXPECT_EQ(levels_for(std::numeric_limits<double>::infinity()), 4);
}

}  // namespace
}  // namespace tessera::pipeline
