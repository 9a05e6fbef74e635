// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/stages/coarse/coarse_budget.hpp"

#include <gtest/gtest.h>

#include "pipeline/stages/coarse/coarse_plans.hpp"

namespace tessera::pipeline {
namespace {

surface::CoarseOptions sized(double size, double timeout_s = 0.0)
{
  surface::CoarseOptions options;
  options.max_size = size;
  options.timeout_s = timeout_s;
  return options;
}

TEST(CoarseBudget, GrowsWithFacesAreaAndTriangles)
{
  const auto seconds = [](const coarse::ModelFigures& model, double size) {
    return surface_limits(sized(size), model, true).cpu_s;
  };
  const double least_s = seconds({.num_faces = 10, .area = 6.0}, 1.0);
  EXPECT_GT(seconds({.num_faces = 5000, .area = 6.0}, 1.0), least_s);
  EXPECT_GT(seconds({.num_faces = 10, .area = 6.0}, 0.01), least_s);
  EXPECT_GT(seconds({.num_faces = 10, .area = 6.0, .num_triangles = 1'000'000}, 1.0), least_s);
}

TEST(CoarseBudget, WhatTheUserSaysCounts)
{
  const coarse::ModelFigures huge{.num_faces = 100'000, .area = 1e9};
  EXPECT_EQ(surface_limits(sized(1.0, 7.0), huge, true).cpu_s, 7.0);
  EXPECT_EQ(whole_limits(sized(1.0, 7.0), 1'000'000).cpu_s, 7.0);
  EXPECT_EQ(domain_limits(sized(1.0, 7.0), {}).cpu_s, 7.0);
}

// Though every try hangs: the two ranks work on them side by side.
TEST(CoarseBudget, AThousandFacesHaveTheirVerdictWithinThreeMinutesOnTwoRanks)
{
  const coarse::ModelFigures model{.num_faces = 1000, .area = 2.0 / 3.0};  // Of a box's diagonal.
  config::Case run_case;
  run_case.geometry.file = "part.step";
  run_case.coarse.max_size = 1.0 / 6.0;
  double all_s = 0.0;
  for (const surface::CoarseOptions& options : coarse_tries(run_case)) {
    const double seconds = surface_limits(options, model, all_s == 0.0).cpu_s;
    EXPECT_LE(seconds, 130.0);
    all_s += seconds;
  }
  EXPECT_LE(all_s, 2.0 * 130.0);
}

TEST(CoarseBudget, OnlyNetgensSurfacesAreWatchedForProgress)
{
  surface::CoarseOptions options = sized(1.0);
  EXPECT_GT(surface_limits(options, {}, true).idle_cpu_s, 0.0);
  options.surface_mesher = surface::SurfaceMesher::remesh;
  EXPECT_EQ(surface_limits(options, {}, true).idle_cpu_s, 0.0);
}

}  // namespace
}  // namespace tessera::pipeline
