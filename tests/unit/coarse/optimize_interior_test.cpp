// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/coarse/optimize_interior.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "support/curved_meshes.hpp"
#include "support/meshes.hpp"

#include "coarse/child_energy.hpp"
#include "coarse/flip_tets.hpp"

namespace tessera::coarse {
namespace {

std::array<Vec3, 4> corners_of(const mesh::CoarseMesh& mesh, LocalIndex t)
{
  const auto tet = mesh.tet(t);
  return {mesh.position(tet[0]), mesh.position(tet[1]), mesh.position(tet[2]),
          mesh.position(tet[3])};
}

double mean_energy(const mesh::CoarseMesh& mesh)
{
  double sum = 0.0;
  for (LocalIndex t = 0; t < mesh.num_tets(); ++t) sum += child_energy(corners_of(mesh, t));
  return sum / mesh.num_tets();
}

double volume_of(const mesh::CoarseMesh& mesh, LocalIndex material)
{
  double sum = 0.0;
  for (LocalIndex t = 0; t < mesh.num_tets(); ++t) {
    const auto [a, b, c, d] = corners_of(mesh, t);
    if (mesh.tet_material[at(t)] == material) sum += tet_volume(a, b, c, d);
  }
  return sum;
}

LocalIndex num_with_two_faces_on_a_patch(const mesh::CoarseMesh& mesh)
{
  const Geometry geometry(mesh);
  LocalIndex found = 0;
  for (LocalIndex t = 0; t < mesh.num_tets(); ++t) {
    const auto tet = mesh.tet(t);
    found += geometry.has_two_faces_on_a_patch({tet[0], tet[1], tet[2], tet[3]}) ? 1 : 0;
  }
  return found;
}

// Moves the vertices off the geometry by at most `most` along each axis.
void shake(mesh::CoarseMesh& mesh, double most)
{
  const Geometry geometry(mesh);
  std::minstd_rand random(7);
  for (LocalIndex v = 0; v < mesh.num_vertices(); ++v) {
    if (geometry.has_vertex(v)) continue;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double share = static_cast<double>(random()) / static_cast<double>(random.max());
      mesh.vertex_xyz[3 * at(v) + axis] += most * (2.0 * share - 1.0);
    }
  }
}

TEST(ChildEnergy, OfTheTetWhoseChildrenHaveItsShapeIsItsOwn)
{
  // The disphenoid of the body-centred lattice: mean ratio 12 (3 V)^(2/3) / sum of squares.
  const std::array<Vec3, 4> disphenoid{{{0, 0, 0}, {2, 0, 0}, {1, 1, -1}, {1, 1, 1}}};
  EXPECT_NEAR(child_energy(disphenoid), std::pow(0.9524406, -3.0), 1e-5);
}

TEST(ChildEnergy, OfARegularTetIsHigherThanItsOwn)
{
  const std::array<Vec3, 4> regular{{{0, 0, 0}, {1, 1, 0}, {0, 1, 1}, {1, 0, 1}}};
  const std::array<Vec3, 4> positive{{regular[0], regular[2], regular[1], regular[3]}};
  const double energy = std::min(child_energy(regular), child_energy(positive));
  EXPECT_GT(energy, 1.1);
  EXPECT_LT(energy, 1.5);
}

TEST(ChildEnergy, OfAnInvertedOrFlatTetIsInfinite)
{
  EXPECT_EQ(child_energy({{{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {0, 0, 1}}}), kNoTet);
  EXPECT_EQ(child_energy({{{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, 0}}}), kNoTet);
}

TEST(OptimizeInterior, MakesChildrenBetterAndLeavesTheGeometryAlone)
{
  mesh::CoarseMesh mesh = testing::kuhn_cube(4);
  shake(mesh, 0.05);
  const mesh::CoarseMesh before = mesh;
  const InteriorStatistics done = optimize_interior(mesh);
  EXPECT_GT(done.num_flips, 0);
  EXPECT_GT(done.num_moves, 0);
  EXPECT_NO_THROW(mesh::validate(mesh));
  EXPECT_LT(mean_energy(mesh), 0.9 * mean_energy(before));
  EXPECT_NEAR(volume_of(mesh, 1), 1.0, 1e-12);
  EXPECT_EQ(mesh.face_vertices, before.face_vertices);
  EXPECT_EQ(mesh.segment_vertices, before.segment_vertices);
  EXPECT_EQ(mesh.num_vertices(), before.num_vertices());
  for (const LocalIndex v : mesh.face_vertices) EXPECT_EQ(mesh.position(v), before.position(v));
}

TEST(OptimizeInterior, KeepsTheMaterialsApart)
{
  mesh::CoarseMesh mesh = testing::two_material_cube(4);
  shake(mesh, 0.05);
  EXPECT_GT(optimize_interior(mesh).num_flips, 0);
  EXPECT_NO_THROW(mesh::validate(mesh));
  EXPECT_NEAR(volume_of(mesh, 1), 0.5, 1e-12);
  EXPECT_NEAR(volume_of(mesh, 2), 0.5, 1e-12);
}

// An octahedron cut along z, though it is shortest along x. Its faces are on patches of their own,
// or those that differ in the sign of x alone share one.
mesh::CoarseMesh octahedron(bool share_patches)
{
  mesh::CoarseMesh mesh;
  mesh.vertex_xyz = {0.8, 0, 0, -0.8, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1};
  mesh.tet_vertices = {5, 4, 0, 2, 5, 4, 2, 1, 5, 4, 1, 3, 5, 4, 3, 0};
  mesh.tet_material.assign(4, 1);
  mesh.material_names = {"body"};
  for (LocalIndex f = 0; f < 8; ++f) {
    const LocalIndex x = f / 4;
    mesh.face_vertices.insert(mesh.face_vertices.end(), {x, 2 + f / 2 % 2, 4 + f % 2});
    mesh.face_patch.push_back(share_patches ? f % 4 : f);
  }
  mesh.patch_surface.assign(8, 0);
  mesh.patch_names.assign(8, "skin");
  return mesh;
}

TEST(OptimizeInterior, MakesNoTetsWithTwoFacesOnAPatch)
{
  mesh::CoarseMesh plain = octahedron(false);
  EXPECT_EQ(optimize_interior(plain).num_flips, 1) << "the shortest diagonal is the best";
  EXPECT_NO_THROW(mesh::validate(plain));
  mesh::CoarseMesh shared = octahedron(true);
  EXPECT_EQ(optimize_interior(shared).num_flips, 0);
  EXPECT_EQ(num_with_two_faces_on_a_patch(shared), 0);
}

TEST(OptimizeInterior, TakesTetsWithTwoFacesOnAPatchAway)
{
  mesh::CoarseMesh ball = testing::ball(4);
  const LocalIndex before = num_with_two_faces_on_a_patch(ball);
  ASSERT_GT(before, 0);
  optimize_interior(ball);
  EXPECT_NO_THROW(mesh::validate(ball));
  EXPECT_LT(num_with_two_faces_on_a_patch(ball), before);
}

TEST(OptimizeInterior, MovesNothingIfAllVerticesAreOnTheGeometry)
{
  mesh::CoarseMesh mesh = testing::kuhn_cube(1);
  const mesh::CoarseMesh before = mesh;
  optimize_interior(mesh);
  EXPECT_NO_THROW(mesh::validate(mesh));
  EXPECT_EQ(mesh.vertex_xyz, before.vertex_xyz);
}

}  // namespace
}  // namespace tessera::coarse
