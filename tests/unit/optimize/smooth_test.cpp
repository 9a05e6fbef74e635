// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/optimize/smooth.hpp"

#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tessera/base/error.hpp"

#include "sample_meshes.hpp"
#include "smoothed_meshes.hpp"

namespace tessera::optimize {
namespace {

using testing::bits_of;
using testing::boundary_flags;
using testing::figures_of;
using testing::Flags;
using testing::inner_flags;
using testing::jittered_cube;
using testing::MeshFigures;
using testing::num_moved;
using testing::positive_meshes;
using testing::tangled_cube;

TetMesh with_fixed_boundary(TetMesh mesh)
{
  mesh.vertex_fixed = boundary_flags(mesh);
  return mesh;
}

Schedule schedule_of(const char* steps) { return {.steps = parse_steps(steps)}; }

TEST(Smooth, KeepsFixedVerticesAndMakesTetsBetter)
{
  for (const char* steps : {"m", "mww", "wtw", "mmtww"}) {
    for (const unsigned seed : {1U, 2U, 3U}) {
      const TetMesh mesh = with_fixed_boundary(jittered_cube(6, 0.8, seed));
      const std::vector<double> moved = smooth(mesh, schedule_of(steps));
      EXPECT_GT(num_moved(mesh, inner_flags(mesh), moved), 0);
      const MeshFigures before = figures_of(mesh.vertex_xyz, mesh.tet_vertices);
      const MeshFigures after = figures_of(moved, mesh.tet_vertices);
      EXPECT_GT(after.least_volume, 0.0);
      EXPECT_NEAR(after.volume, before.volume, 1e-12);
      EXPECT_GE(after.least_mean_ratio, before.least_mean_ratio * (1.0 - 1e-12));
      EXPECT_GT(after.mean_mean_ratio, before.mean_mean_ratio);
    }
  }
}

TEST(Smooth, KeepsTetsPositiveHoweverFlatTheyAre)
{
  for (const TetMesh& positive : positive_meshes()) {
    const TetMesh mesh = with_fixed_boundary(positive);
    const std::vector<double> moved = smooth(mesh, schedule_of("mww"));
    const MeshFigures before = figures_of(mesh.vertex_xyz, mesh.tet_vertices);
    const MeshFigures after = figures_of(moved, mesh.tet_vertices);
    EXPECT_GT(after.least_volume, 0.0);
    EXPECT_GE(after.least_mean_ratio, before.least_mean_ratio * (1.0 - 1e-9));
    static_cast<void>(num_moved(mesh, inner_flags(mesh), moved));
  }
}

TEST(Smooth, AllMayMoveWhereNothingIsFlagged)
{
  TetMesh mesh = jittered_cube(4, 0.8, 4);
  mesh.vertex_fixed.assign(mesh.vertex_xyz.size() / 3, 0);
  const std::vector<double> moved = smooth(mesh, schedule_of("m"));
  EXPECT_NE(bits_of(moved, 0), bits_of(mesh.vertex_xyz, 0)) << "a corner of the cube";
}

TEST(Smooth, NothingMovesIfAllIsFixedOrNoStepIsAskedFor)
{
  TetMesh mesh = with_fixed_boundary(jittered_cube(4, 0.8, 5));
  EXPECT_EQ(smooth(mesh, {}), mesh.vertex_xyz);
  mesh.vertex_fixed.assign(mesh.vertex_fixed.size(), 1);
  EXPECT_EQ(smooth(mesh, schedule_of("mww")), mesh.vertex_xyz);
  EXPECT_TRUE(smooth({}, schedule_of("mww")).empty());
}

TEST(Smooth, MakesInvertedTetsPositive)
{
  for (const double jitter : {0.6, 0.8}) {
    for (const unsigned seed : {1U, 2U, 3U, 4U}) {
      const TetMesh mesh = with_fixed_boundary(tangled_cube(5, jitter, seed));
      ASSERT_LT(figures_of(mesh.vertex_xyz, mesh.tet_vertices).least_volume, 0.0);
      const std::vector<double> moved = smooth(mesh, schedule_of("mww"));
      EXPECT_GT(figures_of(moved, mesh.tet_vertices).least_mean_ratio, 0.2);
      EXPECT_GT(num_moved(mesh, inner_flags(mesh), moved), 0);
    }
  }
}

TEST(Smooth, ReturnsTetsThatCannotBePositive)
{
  TetMesh mesh = testing::one_tet();
  mesh.vertex_xyz[11] = -1.0;
  mesh.vertex_fixed.assign(4, 1);
  EXPECT_EQ(smooth(mesh, schedule_of("mww")), mesh.vertex_xyz);
}

TEST(Smooth, DoesNotDependOnTheUnitOfLength)
{
  const TetMesh mesh = with_fixed_boundary(tangled_cube(4, 0.7, 6));
  const std::vector<double> expected = smooth(mesh, schedule_of("mww"));
  for (const double scale : {std::ldexp(1.0, -300), std::ldexp(1.0, 300)}) {
    TetMesh scaled = mesh;
    for (double& x : scaled.vertex_xyz) x *= scale;
    std::vector<double> moved = smooth(scaled, schedule_of("mww"));
    for (double& x : moved) x /= scale;
    EXPECT_EQ(moved, expected);
  }
}

TEST(Smooth, RefusesStepsThatChangeTets)
{
  const TetMesh mesh = with_fixed_boundary(jittered_cube(2, 0.5, 7));
  for (const char* steps : {"s", "c", "mws"}) {
    EXPECT_THROW(static_cast<void>(smooth(mesh, schedule_of(steps))), ConfigError) << steps;
  }
}

// What is said of a cube after a change.
using Change = std::function<void(TetMesh&, Flags&)>;

std::string refusal_of(bool at_once, const Change& change)
{
  TetMesh mesh = jittered_cube(3, 0.5, 8);
  Flags flags = at_once ? inner_flags(mesh) : boundary_flags(mesh);
  change(mesh, flags);
  try {
    if (at_once) {
      static_cast<void>(smooth_at_once(mesh, flags));
    } else {
      mesh.vertex_fixed = flags;
      static_cast<void>(smooth(mesh, schedule_of("m")));
    }
  } catch (const MeshError& error) {
    return error.what();
  }
  return {};
}

struct SmoothInput : ::testing::TestWithParam<bool> {};

TEST_P(SmoothInput, IsValidWithoutAChange)
{
  EXPECT_EQ(refusal_of(GetParam(), [](TetMesh&, Flags&) {}), "");
}

TEST_P(SmoothInput, RefusesFlagsThatDoNotFit)
{
  EXPECT_NE(refusal_of(GetParam(), [](TetMesh&, Flags& flags) { flags.clear(); }), "");
  EXPECT_NE(refusal_of(GetParam(), [](TetMesh&, Flags& flags) { flags.pop_back(); }), "");
  EXPECT_NE(refusal_of(GetParam(), [](TetMesh&, Flags& flags) { flags.push_back(0); }), "");
}

TEST_P(SmoothInput, RefusesIndicesOutOfRange)
{
  for (const std::size_t tet : {0U, 7U, 161U}) {
    for (const LocalIndex v : {-1, 64}) {
      const auto change = [&](TetMesh& mesh, Flags&) { mesh.tet_vertices[4 * tet + 2] = v; };
      EXPECT_EQ(refusal_of(GetParam(), change),
                "tet " + std::to_string(tet) + " has vertex " + std::to_string(v) + " of 64");
    }
  }
}

// Also of tets that have no vertex to move.
TEST_P(SmoothInput, RefusesPositionsThatAreNotFinite)
{
  for (const double x : {std::nan(""), std::numeric_limits<double>::infinity()}) {
    const auto change = [x](TetMesh& mesh, Flags&) { mesh.vertex_xyz[4] = x; };
    EXPECT_EQ(refusal_of(GetParam(), change), "vertex 1 of tet 0 is not finite");
  }
}

TEST_P(SmoothInput, RefusesTetsThatAreNotFourVertices)
{
  EXPECT_NE(refusal_of(GetParam(), [](TetMesh& mesh, Flags&) { mesh.tet_vertices.pop_back(); }),
            "");
  EXPECT_NE(refusal_of(GetParam(), [](TetMesh& mesh, Flags&) { mesh.vertex_xyz.pop_back(); }), "");
}

INSTANTIATE_TEST_SUITE_P(Both, SmoothInput, ::testing::Bool(),
                         [](const auto& one) { return one.param ? "AtOnce" : "OneByOne"; });

}  // namespace
}  // namespace tessera::optimize
