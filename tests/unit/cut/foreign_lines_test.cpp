// SPDX-License-Identifier: BSD-3-Clause
// What is cut on one side of a border is known on the other one.
#include "cut/foreign_lines.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "tessera/cut/choose_planes.hpp"

#include "cut/judge_plane.hpp"
#include "cut/solid_surfaces.hpp"
#include "sample_models.hpp"

namespace tessera::cut {
namespace {

constexpr double kSize = 0.5;
constexpr LocalIndex kLabel = 90;
const Plane kFirst{{1, 0, 0}, 1.0};

Plane across(double offset) { return {{0, 1, 0}, offset}; }

// A cube of side 2, cut in its middle; what is below is cut again, at y = 0.8.
struct CutCube {
  CutSides halves =
      cut_part(solid_surfaces(testing::box(2, 2, 2), kSize).front().surface, kFirst, kLabel, kSize);
  ForeignLines lines{};

  CutCube() { lines.keep(cut_part(halves.below, across(0.8), kLabel + 1, kSize).traces, 7); }

  [[nodiscard]] PartSurface above(const std::vector<HalfSpace>& cell) const
  {
    return lines.with_lines(halves.above, 0, cell, kSize);
  }
};

TEST(ForeignLines, APlaneBesideTheNeighboursIsNotClear)
{
  const CutCube cube;
  EXPECT_NEAR(judge_plane(cube.halves.above, across(0.81), kSize).clearance, 0.81 / kSize, 1e-9);
  const PartSurface lined = cube.above({{kFirst, kLabel, true}});
  EXPECT_NEAR(judge_plane(lined, across(0.81), kSize).clearance, 0.01 / kSize, 1e-9);
}

TEST(ForeignLines, APlaneAcrossThemDividesItsEdge)
{
  const CutCube cube;
  const PartSurface lined = cube.above({{kFirst, kLabel, true}});
  const Plane plane{{0, 0, 1}, 1.1};
  EXPECT_NEAR(judge_plane(cube.halves.above, plane, kSize).shortest_edge, 1.0 / kSize, 1e-9);
  EXPECT_NEAR(judge_plane(lined, plane, kSize).shortest_edge, 0.8 / kSize, 1e-9);
}

TEST(ForeignLines, EndWhereThePartEnds)
{
  const CutCube cube;
  const std::vector<HalfSpace> cell{{kFirst, kLabel, true}, {{{0, 0, 1}, 0.5}, kLabel + 2, true}};
  const PartSurface lined = cube.above(cell);
  double length = 0.0;
  for (const FeatureEdge& edge : lined.edges) {
    if (edge.foreign != 7) continue;
    length += norm(lined.points[at(edge.vertices[1])] - lined.points[at(edge.vertices[0])]);
  }
  EXPECT_NEAR(length, 1.5, 1e-9);
  EXPECT_EQ(cube.above({{kFirst, kLabel, true}, {across(1.0), kLabel + 2, true}}).edges.size(),
            cube.halves.above.edges.size());
}

TEST(ForeignLines, TheOwnSideDoesNotSeeThem)
{
  const CutCube cube;
  const PartSurface below =
      cube.lines.with_lines(cube.halves.below, 0, {{kFirst, kLabel, false}}, kSize);
  EXPECT_EQ(below.edges.size(), cube.halves.below.edges.size());
}

// No two lines on a border between two solids nearly coincide.
TEST(ForeignLines, PlanesOfTwoSolidsAreTheSameOrApart)
{
  const CutChoice choice = choose_planes(testing::two_cubes(), {.parts = 12, .coarse_size = 0.2});
  ASSERT_GE(choice.tree.num_parts, 8);
  int num_compared = 0;
  for (const PlaneJudgement& a : choice.report.planes) {
    for (const PlaneJudgement& b : choice.report.planes) {
      const Plane& p = choice.tree.nodes[at(a.node)].plane;
      const Plane& q = choice.tree.nodes[at(b.node)].plane;
      // Those across x draw no lines on the border.
      const bool is_along_x = std::abs(p.normal[0]) > 0.99;
      if (a.solid == b.solid || is_along_x || norm(p.normal - q.normal) > 0.01) continue;
      ++num_compared;
      const double apart = std::abs(p.offset - q.offset);
      EXPECT_TRUE(p == q || apart > 0.05) << apart;
    }
  }
  EXPECT_GT(num_compared, 0);
}

}  // namespace
}  // namespace tessera::cut
