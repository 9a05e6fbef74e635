// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/coarse/thin_walls.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "tessera/coarse/sharp_tets.hpp"

#include "support/meshes.hpp"

namespace tessera::coarse {
namespace {

constexpr double kSmall_deg = 5.0;

// A plate of one layer of tets, every side a patch.
mesh::CoarseMesh plate(double thickness)
{
  mesh::CoarseMesh mesh = testing::kuhn_cube(1);
  for (LocalIndex v = 0; v < mesh.num_vertices(); ++v) mesh.vertex_xyz[3 * at(v) + 2] *= thickness;
  return mesh;
}

TEST(ThinWalls, AreNoneInACube)
{
  EXPECT_TRUE(sizes_of_thin_walls(testing::kuhn_cube(3), kSmall_deg, 0.5).size.empty());
}

TEST(ThinWalls, AskForEdgesOfSomeTimesTheirThickness)
{
  constexpr double kThickness = 0.03;
  const mesh::SizePoints sizes = sizes_of_thin_walls(plate(kThickness), kSmall_deg, 1.0);
  ASSERT_FALSE(sizes.size.empty());
  ASSERT_EQ(sizes.xyz.size(), 3 * sizes.size.size());
  for (const double size : sizes.size) {
    EXPECT_GE(size, 4.0 * kThickness);
    EXPECT_LE(size, 8.0 * kThickness * (1.0 + 1e-12));
  }
  for (std::size_t i = 0; i < sizes.size.size(); ++i) {
    EXPECT_LE(sizes.xyz[3 * i + 2], kThickness);
  }
}

TEST(ThinWalls, DoNotAskForLessThanATenthOfTheLargestSize)
{
  const mesh::SizePoints sizes = sizes_of_thin_walls(plate(1e-6), kSmall_deg, 1.0);
  ASSERT_FALSE(sizes.size.empty());
  EXPECT_EQ(std::ranges::min(sizes.size), 0.1);
}

TEST(ThinWalls, AreLeftWhereTheMeshWouldBeOutOfProportion)
{
  EXPECT_TRUE(sizes_of_thin_walls(plate(1e-3), kSmall_deg, 0.05).size.empty());
}

// A flat tet with a corner inside is none between two sheets.
TEST(ThinWalls, AreNoFlatTetsInside)
{
  mesh::CoarseMesh mesh = testing::kuhn_cube(2);
  for (LocalIndex v = 0; v < mesh.num_vertices(); ++v) {
    if (mesh.position(v) == Vec3{0.5, 0.5, 0.5}) mesh.vertex_xyz[3 * at(v) + 2] = 0.02;
  }
  ASSERT_GT(find_sharp_tets(mesh, kSmall_deg).num_others, 0);
  EXPECT_TRUE(sizes_of_thin_walls(mesh, kSmall_deg, 1.0).size.empty());
}

}  // namespace
}  // namespace tessera::coarse
