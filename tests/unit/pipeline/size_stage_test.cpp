// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/stages/size_stage.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "support/meshes.hpp"

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

// Half of the edges of a Kuhn cube's only cell are 1 or shorter, the longest is sqrt(3).
TEST(CorrectedMaxSize, BringsTheMiddleOfTheCoarseEdgesDown)
{
  const mesh::CoarseMesh cube = testing::kuhn_cube(4);
  const auto middle_over_target = [](double target) {
    return std::sqrt(2.0) * 0.25 / (4.0 * target);  // Levels: 2.
  };
  const double coarse_enough = 0.2;
  ASSERT_LT(middle_over_target(coarse_enough), 0.94);
  EXPECT_EQ(corrected_max_size(cube, 1.0, coarse_enough, 2), std::nullopt);
  const double too_fine = 0.05;
  const auto smaller = corrected_max_size(cube, 1.0, too_fine, 2);
  ASSERT_TRUE(smaller.has_value());
  EXPECT_NEAR(*smaller, 0.94 / middle_over_target(too_fine), 1e-12);
}

}  // namespace
}  // namespace tessera::pipeline
