// SPDX-License-Identifier: BSD-3-Clause
#include "layers/ridges.hpp"

#include <algorithm>
#include <set>
#include <utility>

#include <gtest/gtest.h>

#include "tessera/mesh/tet_topology.hpp"

#include "support/meshes.hpp"
#include "support/wedge_cube.hpp"

namespace tessera::layers {
namespace {

WallSurface walls_of(const mesh::CoarseMesh& cube, const std::vector<std::size_t>& patches)
{
  std::vector<PatchLayers> layers(at(cube.num_patches()));
  for (const std::size_t patch : patches) layers[patch].thickness = 0.05;
  return find_walls(cube, layers);
}

std::set<std::array<LocalIndex, 2>> edges_of(const mesh::CoarseMesh& mesh)
{
  std::set<std::array<LocalIndex, 2>> edges;
  for (LocalIndex t = 0; t < mesh.num_tets(); ++t) {
    for (const auto& [a, b] : mesh::kTetEdgeCorners) {
      edges.insert(mesh::sorted_edge(mesh.tet(t)[a], mesh.tet(t)[b]));
    }
  }
  return edges;
}

TEST(FindRidges, FindsTheEdgeOfAWedge)
{
  const mesh::CoarseMesh cube = testing::wedge_cube(0.1);
  const auto ridges = find_ridges(cube, walls_of(cube, {6, 7}));
  ASSERT_EQ(ridges.size(), 4U);
  for (const Ridge& ridge : ridges) {
    EXPECT_LT(norm(ridge.middle - Vec3{1.0, 0.0, 0.0}), 1e-12);
    for (const LocalIndex v : ridge.edge) EXPECT_EQ(cube.position(v)[0], 0.5);
  }
  EXPECT_TRUE(find_ridges(cube, walls_of(cube, {6})).empty());
  const mesh::CoarseMesh whole = testing::kuhn_cube(2);
  EXPECT_TRUE(find_ridges(whole, walls_of(whole, {0, 1, 2, 3, 4, 5})).empty());
}

// Down to 23 degrees one column will do.
TEST(IsRidge, ToldByTheAngle)
{
  for (const auto& [thickness, num_ridges] : {std::pair(0.19, 4U), std::pair(0.22, 0U)}) {
    const mesh::CoarseMesh cube = testing::wedge_cube(thickness);
    EXPECT_EQ(find_ridges(cube, walls_of(cube, {6, 7})).size(), num_ridges);
  }
}

// From the edge of the wedge to the wall across it.
TEST(DivideAtRidges, LeavesNoEdgeFromWallToWall)
{
  mesh::CoarseMesh cube = testing::wedge_cube(0.1);
  const mesh::CoarseMesh before = cube;
  const std::vector<std::size_t> patches{1, 2, 6, 7};
  divide_at_ridges(walls_of(cube, patches), cube);
  EXPECT_GT(cube.num_vertices(), before.num_vertices());
  EXPECT_EQ(cube.face_vertices, before.face_vertices);
  EXPECT_NO_THROW(mesh::validate(cube));
  EXPECT_NEAR(testing::volume_of(cube), testing::volume_of(before), 1e-12);
  const WallSurface walls = walls_of(cube, patches);
  std::set<std::array<LocalIndex, 2>> on_surface;
  for (LocalIndex f = 0; f < cube.num_faces(); ++f) {
    const LocalIndex* v = &cube.face_vertices[3 * at(f)];
    for (std::size_t c = 0; c < 3; ++c) on_surface.insert(mesh::sorted_edge(v[c], v[(c + 1) % 3]));
  }
  std::set<LocalIndex> on_ridges;
  for (const Ridge& ridge : find_ridges(cube, walls)) {
    on_ridges.insert(ridge.edge.begin(), ridge.edge.end());
  }
  std::size_t num_seen = 0;
  for (const auto& edge : edges_of(cube)) {
    if (std::ranges::none_of(edge, [&](LocalIndex v) { return on_ridges.contains(v); })) continue;
    ++num_seen;
    const bool joins_walls = std::ranges::all_of(
        edge, [&](LocalIndex v) { return walls.wall_of_vertex[at(v)] != kNoIndex; });
    EXPECT_TRUE(!joins_walls || on_surface.contains(edge));
  }
  EXPECT_GT(num_seen, 0U);
}

TEST(DivideAtRidges, LeavesOtherMeshesAlone)
{
  mesh::CoarseMesh cube = testing::kuhn_cube(2);
  divide_at_ridges(walls_of(cube, {0, 1, 2, 3, 4, 5}), cube);
  EXPECT_EQ(cube.tet_vertices, testing::kuhn_cube(2).tet_vertices);
}

}  // namespace
}  // namespace tessera::layers
