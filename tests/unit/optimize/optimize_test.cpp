// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/optimize/optimize.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tessera/base/hash.hpp"

#include "sample_meshes.hpp"

namespace tessera::optimize {
namespace {

using testing::boundary_of;
using testing::figures_of;
using testing::jittered_cube;
using testing::MeshFigures;
using testing::one_tet;
using testing::subdivided_cube;

std::vector<Schedule> all_schedules()
{
  return {fast_schedule(), standard_schedule(), thorough_schedule()};
}

std::string digest_of(const OptimizeResult& result)
{
  return to_hex(hash_bytes(std::as_bytes(std::span(result.vertex_xyz))))
         + to_hex(hash_bytes(std::as_bytes(std::span(result.tet_vertices))));
}

TetMesh with_vertices_of(const OptimizeResult& result)
{
  return {.vertex_xyz = result.vertex_xyz, .tet_vertices = result.tet_vertices};
}

void expect_sound(const TetMesh& before, const OptimizeResult& after)
{
  const MeshFigures old = figures_of(before.vertex_xyz, before.tet_vertices);
  const MeshFigures figures = figures_of(after.vertex_xyz, after.tet_vertices);
  EXPECT_GT(figures.least_volume, 0.0);
  EXPECT_NEAR(figures.volume, old.volume, 1e-12 * old.volume);
  EXPECT_GE(figures.least_mean_ratio, old.least_mean_ratio * (1.0 - 1e-12));
  EXPECT_EQ(boundary_of(after.vertex_xyz, after.tet_vertices),
            boundary_of(before.vertex_xyz, before.tet_vertices));
  std::vector<LocalIndex> rows = after.vertex_origin;
  while (!rows.empty() && rows.back() == kNoIndex) rows.pop_back();
  EXPECT_TRUE(std::is_sorted(rows.begin(), rows.end()));
  EXPECT_TRUE(rows.empty() || rows.front() != kNoIndex);
  EXPECT_EQ(after.vertex_xyz.size(), 3 * after.vertex_origin.size());
}

TEST(Optimize, KeepsBoundaryAndVolumeAndMakesTetsBetter)
{
  for (const Schedule& schedule : all_schedules()) {
    for (const unsigned seed : {1U, 2U, 3U}) {
      const TetMesh mesh = jittered_cube(6, 0.8, seed);
      const OptimizeResult result = optimize(mesh, schedule);
      expect_sound(mesh, result);
      const MeshFigures before = figures_of(mesh.vertex_xyz, mesh.tet_vertices);
      const MeshFigures after = figures_of(result.vertex_xyz, result.tet_vertices);
      EXPECT_GT(after.mean_mean_ratio, before.mean_mean_ratio + 0.1);
      EXPECT_GT(after.least_mean_ratio, 2.0 * before.least_mean_ratio);
      EXPECT_EQ(result.statistics.num_passes, static_cast<int>(schedule.steps.size()));
      EXPECT_GT(result.statistics.num_swaps, 0);
      EXPECT_GT(result.statistics.num_moves, 0);
    }
  }
}

TEST(Optimize, MakesChildrenOfCoarseTetsBetter)
{
  const TetMesh mesh = subdivided_cube(3);
  const MeshFigures before = figures_of(mesh.vertex_xyz, mesh.tet_vertices);
  for (const Schedule& schedule : all_schedules()) {
    const OptimizeResult result = optimize(mesh, schedule);
    expect_sound(mesh, result);
    const MeshFigures after = figures_of(result.vertex_xyz, result.tet_vertices);
    EXPECT_GT(after.mean_mean_ratio, before.mean_mean_ratio + 0.05);
  }
}

TEST(Optimize, EveryKindOfStepIsSoundAlone)
{
  for (const char* steps : {"m", "w", "s", "c", "mmmm", "ssss", "cccc", "i", "iiii", "iwsciwsc"}) {
    const TetMesh mesh = jittered_cube(5, 1.0, 7);
    expect_sound(mesh, optimize(mesh, {.steps = parse_steps(steps)}));
  }
}

TEST(Optimize, CollapseRemovesVerticesThatAreTooClose)
{
  const TetMesh mesh = jittered_cube(6, 1.0, 5);
  const OptimizeResult result = optimize(mesh, standard_schedule());
  EXPECT_GT(result.statistics.num_collapses, 0);
  EXPECT_EQ(static_cast<GlobalIndex>(result.vertex_origin.size()),
            std::ssize(mesh.vertex_xyz) / 3 - result.statistics.num_collapses);
}

TEST(Optimize, InsertionMendsTetsThatNothingElseMends)
{
  TetMesh mesh = jittered_cube(5, 0.9, 17);
  mesh.vertex_fixed.assign(mesh.vertex_xyz.size() / 3, 1);
  mesh = with_vertices_of(optimize(mesh, {.steps = parse_steps("sss")}));
  mesh.vertex_fixed.assign(mesh.vertex_xyz.size() / 3, 1);
  const double before = figures_of(mesh.vertex_xyz, mesh.tet_vertices).least_mean_ratio;
  const OptimizeResult result = optimize(mesh, {.steps = parse_steps("iwiw")});
  expect_sound(mesh, result);
  EXPECT_GT(result.statistics.num_insertions, 0);
  EXPECT_GE(result.vertex_xyz.size(), mesh.vertex_xyz.size());
  EXPECT_GT(figures_of(result.vertex_xyz, result.tet_vertices).least_mean_ratio, 1.1 * before);
  std::size_t num_kept = 0;
  for (std::size_t row = 0; row < result.vertex_origin.size(); ++row) {
    if (result.vertex_origin[row] == kNoIndex) continue;
    ++num_kept;
    EXPECT_EQ(point_at(std::span(result.vertex_xyz), row),
              point_at(std::span(mesh.vertex_xyz), result.vertex_origin[row]));
  }
  EXPECT_EQ(num_kept, mesh.vertex_fixed.size());
}

// All edges are on the boundary, so only the face between the two can give way to an edge.
TEST(Optimize, ThreeTetsAroundAnEdgeTakeThePlaceOfTwo)
{
  const TetMesh mesh{
      .vertex_xyz = {0.0, 0.0, 0.0, 2.0, 0.0, 0.0, -0.2, 1.2, 0.0, 0.6, 0.2, 0.8, 0.3, 0.5, -0.1},
      .tet_vertices = {0, 1, 2, 3, 0, 2, 1, 4}};
  const OptimizeResult result = optimize(mesh, {.steps = parse_steps("s")});
  EXPECT_EQ(result.statistics.num_swaps, 1);
  EXPECT_EQ(result.tet_vertices.size(), 12U);
  EXPECT_EQ(std::ranges::count(result.tet_vertices, 3), 3);
  EXPECT_EQ(std::ranges::count(result.tet_vertices, 4), 3);
}

TEST(Optimize, IsTheSameForEveryInstructionSet)
{
  for (const TetMesh& mesh : {jittered_cube(6, 0.9, 11), subdivided_cube(2)}) {
    for (const Schedule& schedule : all_schedules()) {
      const std::string expected =
          digest_of(optimize(mesh, schedule, {.instruction_set = InstructionSet::baseline}));
      for (const InstructionSet set : available_instruction_sets()) {
        EXPECT_EQ(digest_of(optimize(mesh, schedule, {.instruction_set = set})), expected)
            << name_of(set);
      }
    }
  }
}

TEST(Optimize, IsTheSameWhenRunAgain)
{
  const TetMesh mesh = jittered_cube(6, 0.9, 12);
  EXPECT_EQ(digest_of(optimize(mesh, standard_schedule())),
            digest_of(optimize(mesh, standard_schedule())));
}

TEST(Optimize, DoesNotDependOnTheUnitOfLength)
{
  const TetMesh mesh = jittered_cube(4, 0.9, 13);
  const OptimizeResult expected = optimize(mesh, standard_schedule());
  for (const double scale : {std::ldexp(1.0, -300), std::ldexp(1.0, 300)}) {
    TetMesh scaled = mesh;
    for (double& x : scaled.vertex_xyz) x *= scale;
    OptimizeResult result = optimize(scaled, standard_schedule());
    for (double& x : result.vertex_xyz) x /= scale;
    EXPECT_EQ(digest_of(result), digest_of(expected));
  }
}

TEST(Optimize, IsSoundFarFromTheOrigin)
{
  TetMesh mesh = jittered_cube(4, 0.9, 14);
  for (double& x : mesh.vertex_xyz) x += 1e9;
  const OptimizeResult result = optimize(mesh, standard_schedule());
  const MeshFigures figures = figures_of(result.vertex_xyz, result.tet_vertices);
  EXPECT_GT(figures.least_volume, 0.0);
  EXPECT_EQ(boundary_of(result.vertex_xyz, result.tet_vertices),
            boundary_of(mesh.vertex_xyz, mesh.tet_vertices));
}

TEST(Optimize, FixedVerticesStayWhereTheyAre)
{
  TetMesh mesh = jittered_cube(5, 0.9, 15);
  mesh.vertex_fixed.assign(mesh.vertex_xyz.size() / 3, 0);
  for (std::size_t v = 0; v < mesh.vertex_fixed.size(); v += 3) mesh.vertex_fixed[v] = 1;
  const OptimizeResult result = optimize(mesh, thorough_schedule());
  expect_sound(mesh, result);
  std::size_t num_found = 0;
  for (std::size_t row = 0; row < result.vertex_origin.size(); ++row) {
    const LocalIndex origin = result.vertex_origin[row];
    if (mesh.vertex_fixed[at(origin)] == 0) continue;
    ++num_found;
    EXPECT_EQ(point_at(std::span(result.vertex_xyz), row),
              point_at(std::span(mesh.vertex_xyz), origin));
  }
  EXPECT_EQ(num_found, (mesh.vertex_fixed.size() + 2) / 3);
}

TEST(Optimize, NothingMovesIfAllIsFixed)
{
  TetMesh mesh = jittered_cube(3, 0.5, 16);
  mesh.vertex_fixed.assign(mesh.vertex_xyz.size() / 3, 1);
  const OptimizeResult result = optimize(mesh, {.steps = parse_steps("mwc")});
  EXPECT_EQ(result.vertex_xyz, mesh.vertex_xyz);
  EXPECT_EQ(result.statistics.num_moves, 0);
  EXPECT_EQ(result.statistics.num_collapses, 0);
}

TEST(Optimize, TakesMeshesWithNothingToDo)
{
  const OptimizeResult nothing = optimize({}, thorough_schedule());
  EXPECT_TRUE(nothing.vertex_xyz.empty());
  EXPECT_TRUE(nothing.tet_vertices.empty());

  const OptimizeResult one = optimize(one_tet(), thorough_schedule());
  EXPECT_EQ(one.vertex_xyz, one_tet().vertex_xyz);
  expect_sound(one_tet(), one);
}

TEST(Optimize, TakesMeshesWithoutInnerVertices)
{
  const TetMesh cube = jittered_cube(1, 0.0, 1);
  const OptimizeResult result = optimize(cube, thorough_schedule());
  EXPECT_EQ(result.vertex_xyz, cube.vertex_xyz);
  expect_sound(cube, result);
}

TEST(Optimize, KeepsVerticesOfNoTet)
{
  TetMesh mesh = one_tet();
  mesh.vertex_xyz.insert(mesh.vertex_xyz.begin(), {5.0, 5.0, 5.0});
  for (LocalIndex& v : mesh.tet_vertices) ++v;
  EXPECT_EQ(optimize(mesh, standard_schedule()).vertex_xyz, mesh.vertex_xyz);
}

TEST(Optimize, NeighboursThatAreGivenChangeNothing)
{
  TetMesh mesh = jittered_cube(4, 0.9, 17);
  const OptimizeResult expected = optimize(mesh, standard_schedule());
  mesh.tet_neighbours = testing::neighbours_of(mesh.tet_vertices);
  EXPECT_EQ(digest_of(optimize(mesh, standard_schedule())), digest_of(expected));
}

}  // namespace
}  // namespace tessera::optimize
