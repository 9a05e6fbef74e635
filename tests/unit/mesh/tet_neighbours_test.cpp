// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/mesh/tet_neighbours.hpp"

#include <span>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tessera/base/error.hpp"
#include "tessera/mesh/tet_topology.hpp"

#include "support/meshes.hpp"

namespace tessera::mesh {
namespace {

std::vector<LocalIndex> neighbours_by_triangle(std::span<const LocalIndex> tet_vertices)
{
  std::vector<LocalIndex> neighbours(tet_vertices.size(), kNoIndex);
  for (const TriangleTets& triangle : triangles_of_tets(tet_vertices)) {
    if (triangle.tets[1] == kNoIndex) continue;
    const LocalIndex first = 4 * triangle.tets[0] + triangle.corners[0];
    const LocalIndex second = 4 * triangle.tets[1] + triangle.corners[1];
    neighbours[at(first)] = second;
    neighbours[at(second)] = first;
  }
  return neighbours;
}

std::string error_of(const std::vector<LocalIndex>& tet_vertices, LocalIndex num_vertices,
                     const std::vector<LocalIndex>& tet_name = {})
{
  try {
    static_cast<void>(find_tet_neighbours(tet_vertices, num_vertices, tet_name));
  } catch (const MeshError& error) {
    return error.what();
  }
  return "none";
}

TEST(TetNeighbours, AreThoseOfTheTriangles)
{
  const CoarseMesh cube = testing::kuhn_cube(4);
  EXPECT_EQ(find_tet_neighbours(cube.tet_vertices, cube.num_vertices()),
            neighbours_by_triangle(cube.tet_vertices));
}

TEST(TetNeighbours, AreNoneOfAMeshWithoutTets) { EXPECT_TRUE(find_tet_neighbours({}, 7).empty()); }

// More tets than are compared one by one meet at vertex 0.
TEST(TetNeighbours, TakeVerticesOfManyTets)
{
  std::vector<LocalIndex> fan;
  for (LocalIndex i = 2; i < 102; ++i) fan.insert(fan.end(), {0, 1, i, i + 1});
  EXPECT_EQ(find_tet_neighbours(fan, 103), neighbours_by_triangle(fan));
}

TEST(TetNeighbours, RefuseTetsThatCannotBeAMesh)
{
  EXPECT_EQ(error_of({0, 1, 2, 3, 0, 1, 2, 4}, 5),
            "tet 0 lies on the same side of a triangle as tet 1");
  EXPECT_EQ(error_of({0, 1, 2, 3, 0, 2, 1, 4, 0, 1, 2, 5}, 6, {7, 8, 9}),
            "tet 7 has a triangle of three tets");
}

}  // namespace
}  // namespace tessera::mesh
