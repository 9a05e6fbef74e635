// SPDX-License-Identifier: BSD-3-Clause
#include "layers/wall_surface.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "tessera/topology/periodic_sides.hpp"

#include "support/meshes.hpp"

namespace tessera::layers {
namespace {

constexpr double kThickness = 0.1;

// The walls of kuhn_cube(2), or of what it became; patches x0, x1, y0, y1, z0, z1.
WallSurface walls_of(const mesh::CoarseMesh& cube, const std::vector<std::size_t>& patches)
{
  std::vector<PatchLayers> layers(at(cube.num_patches()));
  for (const std::size_t patch : patches) layers[patch].thickness = kThickness;
  return find_walls(cube, layers);
}

TEST(TriangleShape, IsLargestOfEqualSides)
{
  EXPECT_NEAR(triangle_shape({{{0, 0, 0}, {1, 0, 0}, {0.5, std::sqrt(0.75), 0}}}), std::sqrt(0.75),
              1e-15);
  EXPECT_EQ(triangle_shape({{{0, 0, 0}, {4, 0, 0}, {0, 3, 0}}}), 12.0 / 25.0);
  EXPECT_EQ(triangle_shape({{{0, 0, 0}, {1, 1, 0}, {2, 2, 0}}}), 0.0);
}

TEST(FindWalls, FindsNoneWhereNothingIsWanted)
{
  const WallSurface walls = walls_of(testing::kuhn_cube(2), {});
  EXPECT_TRUE(walls.vertices.empty());
  EXPECT_TRUE(walls.triangles.empty());
}

TEST(FindWalls, LetsColumnsOfOneSideStandUpright)
{
  const mesh::CoarseMesh cube = testing::kuhn_cube(2);
  const WallSurface walls = walls_of(cube, {4});
  ASSERT_EQ(walls.vertices.size(), 9U);
  int num_on_curves = 0;
  int num_on_patches = 0;
  for (const WallVertex& vertex : walls.vertices) {
    EXPECT_EQ(vertex.wall, cube.position(vertex.vertex));
    EXPECT_EQ(vertex.wall[2], 0.0);
    EXPECT_LT(norm(vertex.column - Vec3{0.0, 0.0, kThickness}), 1e-12);
    EXPECT_EQ(&walls.vertices[at(vertex.origin)], &vertex);
    num_on_curves += vertex.curve != kNoIndex ? 1 : 0;
    num_on_patches += vertex.patch != kNoIndex ? 1 : 0;
  }
  EXPECT_EQ(num_on_curves, 4);   // Corners.
  EXPECT_EQ(num_on_patches, 4);  // Middles of sides.
}

TEST(FindWalls, HasTrianglesThatPointAway)
{
  const mesh::CoarseMesh cube = testing::kuhn_cube(2);
  const WallSurface walls = walls_of(cube, {4});
  std::size_t num_walls = 0;
  for (const SurfaceTriangle& triangle : walls.triangles) {
    EXPECT_EQ(triangle.is_wall, cube.face_patch[at(triangle.face)] == 4);
    Vec3 middle{};
    for (const LocalIndex v : triangle.vertices) {
      middle = middle + 1.0 / 3.0 * cube.position(v);
    }
    EXPECT_GT(dot(triangle.normal, middle - Vec3{0.5, 0.5, 0.5}), 0.49);
    EXPECT_NEAR(triangle.least_shape, 0.15, 1e-15);  // A right triangle has 0.5.
    num_walls += triangle.is_wall ? 1 : 0;
  }
  EXPECT_EQ(num_walls, 8U);
  EXPECT_GT(walls.triangles.size(), num_walls);
}

// Layers keep their height beside an edge, so a column between two walls is longer.
TEST(FindWalls, LetsColumnsLeanBetweenTwoWalls)
{
  const mesh::CoarseMesh cube = testing::kuhn_cube(2);
  const WallSurface walls = walls_of(cube, {0, 4});
  EXPECT_EQ(walls.vertices.size(), 15U);
  for (const WallVertex& vertex : walls.vertices) {
    const Vec3 expected{vertex.wall[0] == 0.0 ? kThickness : 0.0, 0.0,
                        vertex.wall[2] == 0.0 ? kThickness : 0.0};
    EXPECT_LT(norm(vertex.column - expected), 0.02 * kThickness) << vertex.vertex;
  }
}

TEST(FindWalls, MakesColumnsOfPeriodicSidesAlike)
{
  mesh::CoarseMesh cube = testing::kuhn_cube(2);
  topology::join_periodic_sides(cube,
                                std::vector<topology::PeriodicSide>{{.from = "x0", .to = "x1"}});
  const WallSurface walls = walls_of(cube, {4});
  int num_images = 0;
  for (const WallVertex& vertex : walls.vertices) {
    const WallVertex& origin = walls.vertices[at(vertex.origin)];
    if (&origin == &vertex) continue;
    ++num_images;
    EXPECT_EQ(vertex.column, origin.column);
    EXPECT_EQ(vertex.wall - origin.wall, (Vec3{1.0, 0.0, 0.0}));
  }
  EXPECT_EQ(num_images, 3);
}

}  // namespace
}  // namespace tessera::layers
