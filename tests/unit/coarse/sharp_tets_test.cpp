// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/coarse/sharp_tets.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "support/meshes.hpp"

namespace tessera::coarse {
namespace {

constexpr double kSmall_deg = 5.0;

// Every face is a patch, so all edges are on curves.
mesh::CoarseMesh one_tet(const std::vector<double>& xyz)
{
  return {.vertex_xyz = xyz,
          .tet_vertices = {0, 1, 2, 3},
          .tet_material = {1},
          .face_vertices = {0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3},
          .face_patch = {0, 1, 2, 3},
          .patch_names = {"a", "b", "c", "d"},
          .patch_surface = {0, 1, 2, 3},
          .material_names = {"m"}};
}

// Its one inner vertex comes near the bottom.
mesh::CoarseMesh cube_with_a_flat_tet()
{
  mesh::CoarseMesh mesh = testing::kuhn_cube(2);
  for (LocalIndex v = 0; v < mesh.num_vertices(); ++v) {
    if (mesh.position(v) == Vec3{0.5, 0.5, 0.5}) mesh.vertex_xyz[3 * at(v) + 2] = 0.02;
  }
  return mesh;
}

TEST(SharpTets, AreNoneInAGoodMesh)
{
  const SharpTets found = find_sharp_tets(testing::kuhn_cube(3), kSmall_deg);
  EXPECT_EQ(found.num_forced, 0);
  EXPECT_EQ(found.num_others, 0);
  EXPECT_TRUE(found.worst.empty());
}

TEST(SharpTets, AreNamedWithTheirPlaces)
{
  const SharpTets found = find_sharp_tets(cube_with_a_flat_tet(), kSmall_deg);
  EXPECT_EQ(found.num_forced, 0);
  ASSERT_GT(found.num_others, 0);
  ASSERT_FALSE(found.worst.empty());
  EXPECT_LE(found.worst.size(), SharpTets::kMost);
  for (const SharpTet& tet : found.worst) {
    EXPECT_GE(tet.angle_deg, found.worst.front().angle_deg);
    EXPECT_LT(tet.angle_deg, kSmall_deg);
    EXPECT_GT(tet.shortest_edge, 0.01);
  }
  EXPECT_TRUE(std::ranges::any_of(found.worst, [](const SharpTet& tet) {
    return tet.centre[2] < 0.1 && std::ranges::count(tet.patches, 4) == 1;
  })) << "one lies on z = 0";
  EXPECT_TRUE(std::ranges::any_of(found.worst, [](const SharpTet& tet) {
    return std::abs(tet.shortest_edge - 0.02) < 1e-12;
  })) << "one has the vertex below";
}

TEST(SharpTets, AreForcedWhereFacesMeetAtASmallAngle)
{
  const SharpTets found =
      find_sharp_tets(one_tet({0, 0, 0, 1, 0, 0, 0, 1, 0, 0.3, 0.3, 0.01}), kSmall_deg);
  EXPECT_EQ(found.num_forced, 1);
  EXPECT_EQ(found.num_others, 0);
}

TEST(SharpTets, AreForcedAtATipOfAFace)
{
  // Two tets on both sides of a face that is narrow at its first vertex. Faces meet at larger
  // angles: the sharp dihedral angles are inside, beside the tip.
  mesh::CoarseMesh mesh = one_tet({0, 0, 0, 1, -0.02, 0, 1, 0.02, 0, 0.5, 0, 1});
  mesh.vertex_xyz.insert(mesh.vertex_xyz.end(), {0.5, 1.0, 0.5});
  mesh.tet_vertices.insert(mesh.tet_vertices.end(), {0, 3, 2, 4});
  mesh.tet_material.push_back(1);
  mesh.face_vertices = {0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 4, 3, 2, 4, 2, 0, 4};
  mesh.face_patch = {0, 1, 2, 3, 3, 3};
  const SharpTets found = find_sharp_tets(mesh, kSmall_deg);
  EXPECT_EQ(found.num_forced, 1);
  EXPECT_EQ(found.num_others, 0);
}

TEST(SharpTets, NameTheRowsOfPatches)
{
  mesh::CoarseMesh mesh = cube_with_a_flat_tet();
  mesh.patch_row.assign(at(mesh.num_patches()), 0);
  const SharpTets found = find_sharp_tets(mesh, kSmall_deg);
  ASSERT_FALSE(found.worst.empty());
  EXPECT_EQ(found.worst.front().patches, std::vector<LocalIndex>{0});
}

}  // namespace
}  // namespace tessera::coarse
