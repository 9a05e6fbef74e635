// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/mesh/face_tets.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "support/meshes.hpp"

namespace tessera::mesh {
namespace {

TEST(TetsOfFaces, AreTwoBetweenMaterialsAndOneOutside)
{
  CoarseMesh cube = testing::two_material_cube(2);
  std::swap(cube.face_vertices[0], cube.face_vertices[2]);  // The orientation is arbitrary.
  const std::vector<TriangleTets> of_faces = tets_of_faces(cube);
  ASSERT_EQ(of_faces.size(), at(cube.num_faces()));
  int num_between = 0;
  for (LocalIndex f = 0; f < cube.num_faces(); ++f) {
    const TriangleTets& tets = of_faces[at(f)];
    const bool is_between = cube.face_patch[at(f)] == 6;
    EXPECT_EQ(tets.tets[1] != kNoIndex, is_between);
    num_between += is_between ? 1 : 0;
    const LocalIndex* v = &cube.face_vertices[3 * at(f)];
    EXPECT_EQ(tets.vertices, sorted_triangle(v[0], v[1], v[2]));
    for (std::size_t side = 0; side < (is_between ? 2U : 1U); ++side) {
      const auto tet = cube.tet(tets.tets[side]);
      for (std::size_t c = 0; c < 4; ++c) {
        EXPECT_EQ(std::ranges::count(tets.vertices, tet[c]) == 0, c == at(tets.corners[side]));
      }
    }
  }
  EXPECT_EQ(num_between, 8);
}

TEST(TetsOfFaces, AreTheSameFromTrianglesThatAreThere)
{
  const CoarseMesh cube = testing::kuhn_cube(2);
  const auto triangles = triangles_of_tets(cube.tet_vertices);
  const auto from_these = tets_of_faces(cube, triangles);
  const auto of_faces = tets_of_faces(cube);
  ASSERT_EQ(from_these.size(), of_faces.size());
  for (std::size_t f = 0; f < of_faces.size(); ++f) {
    EXPECT_EQ(from_these[f].vertices, of_faces[f].vertices);
    EXPECT_EQ(from_these[f].tets, of_faces[f].tets);
  }
}

TEST(TetsOfFaces, OfNothingAreNone) { EXPECT_TRUE(tets_of_faces(CoarseMesh{}).empty()); }

}  // namespace
}  // namespace tessera::mesh
