// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "pipeline/stages/coarse/coarse_plans.hpp"

namespace tessera::pipeline {
namespace {

using surface::CoarseOptions;
using surface::SurfaceMesher;

config::Case case_of(const std::string& file)
{
  config::Case run_case;
  run_case.geometry.file = file;
  run_case.coarse.max_size = 10.0;
  run_case.coarse.grading = 0.4;
  run_case.coarse.defeature = 0.1;
  run_case.coarse.timeout_s = 7.0;
  return run_case;
}

class CoarseTriesOfCad : public ::testing::TestWithParam<std::string> {};

TEST_P(CoarseTriesOfCad, AreTwoOfTheRemesherAndOneOfNetgen)
{
  const config::Case run_case = case_of(GetParam());
  const std::vector<CoarseOptions> tries = coarse_tries(run_case);
  ASSERT_EQ(tries.size(), 3U);
  CoarseOptions expected = run_case.coarse;
  expected.surface_mesher = SurfaceMesher::remesh;
  EXPECT_EQ(tries[0], expected);
  expected.max_size = 5.0;
  expected.defeature = 0.05;
  EXPECT_EQ(tries[1], expected);
  expected = run_case.coarse;
  expected.surface_mesher = SurfaceMesher::netgen;
  expected.defeature = 0.0;  // What is merged is so in triangles of the remesher.
  EXPECT_EQ(tries[2], expected);
}

INSTANTIATE_TEST_SUITE_P(Kinds, CoarseTriesOfCad,
                         ::testing::Values("part.step", "part.brep", "part.stl", "part.geo"));

TEST(CoarseTries, OfGmshHaveBothSizes)
{
  config::Case run_case = case_of("part.step");
  run_case.coarse.mesher = surface::Mesher::gmsh;
  const std::vector<CoarseOptions> tries = coarse_tries(run_case);
  ASSERT_EQ(tries.size(), 2U);
  EXPECT_EQ(tries[0], run_case.coarse);
  EXPECT_EQ(tries[1].mesher, surface::Mesher::gmsh);
  EXPECT_EQ(tries[1].max_size, 5.0);
}

TEST(CoarseTries, OfAMeshIsOne) { EXPECT_EQ(coarse_tries(case_of("part.msh")).size(), 1U); }

}  // namespace
}  // namespace tessera::pipeline
