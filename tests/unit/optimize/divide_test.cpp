// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <set>
#include <span>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tessera/base/error.hpp"
#include "tessera/mesh/tet_topology.hpp"
#include "tessera/optimize/optimize.hpp"

#include "sample_meshes.hpp"

namespace tessera::optimize {
namespace {

using testing::boundary_of;
using testing::figures_of;
using testing::jittered_cube;
using testing::MeshFigures;
using testing::one_tet;
using testing::subdivided_cube;

using Triangle = std::array<LocalIndex, 3>;

// The boundary of a mesh; where `is_wanted(a, b, c)` holds of its points.
template <class Wanted>
std::vector<LocalIndex> boundary_triangles(const TetMesh& mesh, const Wanted& is_wanted)
{
  std::vector<LocalIndex> found;
  for (const mesh::TriangleTets& triangle : mesh::triangles_of_tets(mesh.tet_vertices)) {
    if (triangle.tets[1] != kNoIndex) continue;
    const std::span<const double> xyz(mesh.vertex_xyz);
    const auto& [a, b, c] = triangle.vertices;
    if (!is_wanted(point_at(xyz, a), point_at(xyz, b), point_at(xyz, c))) continue;
    found.insert(found.end(), triangle.vertices.begin(), triangle.vertices.end());
  }
  return found;
}

TetMesh with_all_outer(TetMesh mesh)
{
  mesh.outer_triangles =
      boundary_triangles(mesh, [](const Vec3&, const Vec3&, const Vec3&) { return true; });
  return mesh;
}

// Tets of `after` with several of the outer triangles of `before`, whose vertices are at the same
// places.
std::size_t num_corner_tets(const TetMesh& before, const OptimizeResult& after)
{
  std::set<std::array<Vec3, 3>> outer;
  const auto key = [](const std::vector<double>& xyz, const Triangle& v) {
    std::array<Vec3, 3> points;
    for (std::size_t c = 0; c < 3; ++c) points[c] = point_at(std::span(xyz), v[c]);
    std::ranges::sort(points);
    return points;
  };
  for (std::size_t i = 0; i < before.outer_triangles.size(); i += 3) {
    const LocalIndex* v = &before.outer_triangles[i];
    outer.insert(key(before.vertex_xyz, {v[0], v[1], v[2]}));
  }
  std::size_t num = 0;
  for (std::size_t t = 0; t < after.tet_vertices.size(); t += 4) {
    const LocalIndex* v = &after.tet_vertices[t];
    const auto is_outer = [&](const auto& face) {
      return outer.contains(key(after.vertex_xyz, {v[face[0]], v[face[1]], v[face[2]]}));
    };
    if (std::ranges::count_if(mesh::kTetFaceCorners, is_outer) > 1) ++num;
  }
  return num;
}

std::size_t num_corner_tets(const TetMesh& mesh)
{
  return num_corner_tets(mesh, {.vertex_xyz = mesh.vertex_xyz, .tet_vertices = mesh.tet_vertices});
}

void expect_same_body(const TetMesh& before, const OptimizeResult& after)
{
  const MeshFigures figures = figures_of(after.vertex_xyz, after.tet_vertices);
  const double volume = figures_of(before.vertex_xyz, before.tet_vertices).volume;
  EXPECT_GT(figures.least_volume, 0.0);
  EXPECT_NEAR(figures.volume, volume, 1e-12 * volume);
  EXPECT_EQ(boundary_of(after.vertex_xyz, after.tet_vertices),
            boundary_of(before.vertex_xyz, before.tet_vertices));
  EXPECT_EQ(after.vertex_xyz.size(), 3 * after.vertex_origin.size());
  const auto first_new = std::ranges::find(after.vertex_origin, kNoIndex);
  EXPECT_TRUE(std::is_sorted(after.vertex_origin.begin(), first_new));
  EXPECT_TRUE(std::all_of(first_new, after.vertex_origin.end(),
                          [](LocalIndex origin) { return origin == kNoIndex; }));
}

TEST(Divide, LeavesNoTetWithTwoOuterTriangles)
{
  for (const TetMesh& mesh :
       {with_all_outer(jittered_cube(4, 0.8, 1)), with_all_outer(subdivided_cube(2))}) {
    ASSERT_GT(num_corner_tets(mesh), 0U);
    const OptimizeResult divided = optimize(mesh, {.steps = parse_steps("d")});
    EXPECT_EQ(num_corner_tets(mesh, divided), 0U);
    EXPECT_GT(divided.statistics.num_divided, 0);
    expect_same_body(mesh, divided);
  }
}

TEST(Divide, NoLaterStepMakesAnotherOne)
{
  for (const char* steps : {"dsss", "dccc", "dmw", "dmsmscwmmscwsmmwwtsmmwww"}) {
    for (const unsigned seed : {1U, 2U, 3U}) {
      const TetMesh mesh = with_all_outer(jittered_cube(5, 1.0, seed));
      const OptimizeResult after = optimize(mesh, {.steps = parse_steps(steps)});
      EXPECT_EQ(num_corner_tets(mesh, after), 0U) << steps;
      expect_same_body(mesh, after);
    }
  }
}

TEST(Divide, SwapsAndCollapsesMakeNoneByThemselves)
{
  const TetMesh mesh = with_all_outer(jittered_cube(5, 1.0, 4));
  const Schedule schedule = standard_schedule();
  TetMesh without = mesh;
  without.outer_triangles.clear();
  EXPECT_GT(num_corner_tets(mesh, optimize(without, schedule)), num_corner_tets(mesh))
      << "nothing keeps these from it";
  EXPECT_LE(num_corner_tets(mesh, optimize(mesh, schedule)), num_corner_tets(mesh));
}

TEST(Divide, PutsAVertexIntoATetThatIsAlone)
{
  const TetMesh mesh = with_all_outer(one_tet());
  const OptimizeResult divided = optimize(mesh, {.steps = parse_steps("dmmm")});
  EXPECT_EQ(divided.tet_vertices.size(), 4U * 4U);
  EXPECT_EQ(divided.vertex_origin, (std::vector<LocalIndex>{0, 1, 2, 3, kNoIndex}));
  EXPECT_EQ(num_corner_tets(mesh, divided), 0U);
  expect_same_body(mesh, divided);
}

TEST(Divide, ExchangesAFaceWhereThatIsBetter)
{
  // Two tets on one triangle. The faces of the first at the edge from 0 to 3 are outer.
  TetMesh mesh{.vertex_xyz = {0, 0, 0, 2, 0, 0, 1, 1.7, 0, 1, 0.6, 0.6, 1, 0.6, -0.6},
               .tet_vertices = {0, 1, 2, 3, 0, 2, 1, 4},
               .outer_triangles = {0, 1, 3, 2, 0, 3}};
  ASSERT_EQ(num_corner_tets(mesh), 1U);
  const OptimizeResult divided = optimize(mesh, {.steps = parse_steps("d")});
  EXPECT_EQ(divided.tet_vertices.size(), 3U * 4U);
  EXPECT_EQ(divided.vertex_origin.size(), 5U);
  EXPECT_EQ(num_corner_tets(mesh, divided), 0U);

  mesh.outer_triangles = {0, 1, 3, 2, 0, 3, 0, 1, 4};  // The exchange would bring two together.
  const OptimizeResult more = optimize(mesh, {.steps = parse_steps("d")});
  EXPECT_EQ(more.vertex_origin.size(), 6U);
  EXPECT_EQ(num_corner_tets(mesh, more), 0U);

  mesh.outer_group = {1, 1, 2};  // It brings together two that may meet.
  const OptimizeResult in_groups = optimize(mesh, {.steps = parse_steps("d")});
  EXPECT_EQ(in_groups.vertex_origin.size(), 5U);

  mesh.outer_group = {1, 2, 2};  // No tet has two of one group.
  EXPECT_EQ(optimize(mesh, {.steps = parse_steps("d")}).statistics.num_divided, 0);
}

TEST(Divide, LeavesAMeshAloneThatHasNone)
{
  TetMesh mesh = jittered_cube(4, 0.8, 6);
  const OptimizeResult plain = optimize(mesh, {.steps = parse_steps("d")});
  EXPECT_EQ(plain.statistics.num_divided, 0) << "nothing is said to be outer";
  mesh.outer_triangles = boundary_triangles(mesh, [](const Vec3& a, const Vec3& b, const Vec3& c) {
    return a[2] == 0.0 && b[2] == 0.0 && c[2] == 0.0;
  });
  ASSERT_FALSE(mesh.outer_triangles.empty());
  const OptimizeResult flat = optimize(mesh, {.steps = parse_steps("d")});
  EXPECT_EQ(flat.statistics.num_divided, 0) << "no tet has two faces in a plane";
  EXPECT_EQ(flat.tet_vertices, plain.tet_vertices);
}

TEST(Divide, IsTheSameForEveryInstructionSet)
{
  const TetMesh mesh = with_all_outer(jittered_cube(5, 0.9, 8));
  const Schedule schedule{.steps = parse_steps("dsmcwmmsww")};
  const OptimizeResult expected =
      optimize(mesh, schedule, {.instruction_set = InstructionSet::baseline});
  for (const InstructionSet set : available_instruction_sets()) {
    const OptimizeResult result = optimize(mesh, schedule, {.instruction_set = set});
    EXPECT_EQ(result.vertex_xyz, expected.vertex_xyz) << name_of(set);
    EXPECT_EQ(result.tet_vertices, expected.tet_vertices) << name_of(set);
  }
}

TEST(Divide, RefusesOuterTrianglesThatCannotBe)
{
  for (const std::vector<LocalIndex>& wrong :
       {std::vector<LocalIndex>{0, 1}, {0, 1, 4}, {0, -1, 2}}) {
    TetMesh mesh = one_tet();
    mesh.outer_triangles = wrong;
    EXPECT_THROW(static_cast<void>(optimize(mesh, {.steps = parse_steps("d")})), MeshError);
  }
  for (const std::vector<LocalIndex>& wrong : {std::vector<LocalIndex>{0, 0}, {-1}}) {
    TetMesh mesh = one_tet();
    mesh.outer_triangles = {0, 1, 2};
    mesh.outer_group = wrong;
    EXPECT_THROW(static_cast<void>(optimize(mesh, {.steps = parse_steps("d")})), MeshError);
  }
}

}  // namespace
}  // namespace tessera::optimize
