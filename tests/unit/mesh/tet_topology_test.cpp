// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/mesh/tet_topology.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "tessera/base/error.hpp"
#include "tessera/base/vec3.hpp"
#include "tessera/mesh/tet_edges.hpp"

#include "support/meshes.hpp"

namespace tessera::mesh {
namespace {

TEST(TetTopology, FacesOfAPositiveTetPointOutwards)
{
  const std::array<Vec3, 4> tet{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  for (std::size_t corner = 0; corner < 4; ++corner) {
    const auto& [a, b, c] = kTetFaceCorners[corner];
    EXPECT_LT(tet_volume(tet[a], tet[b], tet[c], tet[corner]), 0.0) << "face " << corner;
  }
}

TEST(TetTopology, EvenTrianglesAreTheRotationsOfTheAscendingOrder)
{
  EXPECT_TRUE(is_even_triangle(1, 2, 3));
  EXPECT_TRUE(is_even_triangle(2, 3, 1));
  EXPECT_TRUE(is_even_triangle(3, 1, 2));
  EXPECT_FALSE(is_even_triangle(1, 3, 2));
  EXPECT_FALSE(is_even_triangle(3, 2, 1));
  EXPECT_FALSE(is_even_triangle(2, 1, 3));
}

TEST(TetTopology, ASortedTetKnowsTheSidesOfItsFaces)
{
  std::array<LocalIndex, 4> tet{2, 3, 5, 8};
  int orders = 0;
  do {
    const SortedTet sorted = sorted_tet(tet);
    EXPECT_EQ(sorted.vertices, (std::array<LocalIndex, 4>{2, 3, 5, 8}));
    for (std::size_t corner = 0; corner < 4; ++corner) {
      const auto& [a, b, c] = kTetFaceCorners[corner];
      const auto opposite = std::ranges::find(sorted.vertices, tet[corner]);
      EXPECT_EQ(sorted.is_even_face(static_cast<std::size_t>(opposite - sorted.vertices.begin())),
                is_even_triangle(tet[a], tet[b], tet[c]));
    }
    ++orders;
  } while (std::ranges::next_permutation(tet).found);
  EXPECT_EQ(orders, 24);
}

TEST(TetTopology, AnEdgeIsKnownByItsVerticesInOrder)
{
  EXPECT_EQ(sorted_edge(7, 3), (std::array<LocalIndex, 2>{3, 7}));
  EXPECT_EQ(sorted_edge(3, 7), sorted_edge(7, 3));
}

TEST(TetTopology, ACornerOfACubeHasThreeRightAngles)
{
  const std::array<Vec3, 4> tet{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  for (std::size_t edge = 0; edge < kTetEdgeCorners.size(); ++edge) {
    const bool is_at_corner = kTetEdgeCorners[edge][0] == 0;
    EXPECT_NEAR(dihedral_angle(tet, edge), std::acos(is_at_corner ? 0.0 : 1.0 / std::sqrt(3.0)),
                1e-15)
        << "edge " << edge;
  }
}

TEST(TetTopology, VisitsEveryEdgeOnce)
{
  const std::vector<LocalIndex> tets{3, 1, 2, 0, 4, 3, 1, 2};
  std::vector<std::pair<LocalIndex, LocalIndex>> edges;
  for_each_edge(tets, 6, [&](LocalIndex a, LocalIndex b) { edges.emplace_back(a, b); });
  std::ranges::sort(edges);
  EXPECT_EQ(edges, (std::vector<std::pair<LocalIndex, LocalIndex>>{
                       {0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {1, 4}, {2, 3}, {2, 4}, {3, 4}}));
}

TEST(TetTopology, FindsTheSharedTriangleOfTwoTets)
{
  const std::vector<LocalIndex> tets{0, 1, 2, 3, 1, 2, 3, 4};

  const auto triangles = triangles_of_tets(tets);

  ASSERT_EQ(triangles.size(), 7U);
  int shared = 0;
  for (const TriangleTets& triangle : triangles) {
    if (triangle.tets[1] == kNoIndex) continue;
    ++shared;
    EXPECT_EQ(triangle.vertices, (std::array<LocalIndex, 3>{1, 2, 3}));
    EXPECT_EQ(triangle.corners, (std::array<LocalIndex, 2>{0, 3}));
  }
  EXPECT_EQ(shared, 1);
}

TEST(TetTopology, RefusesATriangleOfThreeTets)
{
  const std::vector<LocalIndex> tets{0, 1, 2, 3, 1, 2, 3, 4, 1, 2, 3, 5};

  EXPECT_THROW(static_cast<void>(triangles_of_tets(tets)), MeshError);
}

TEST(CountEdges, CountsThoseOfSeveralTetsOnce)
{
  EXPECT_EQ(count_edges(std::vector<LocalIndex>{}, 0), 0);
  EXPECT_EQ(count_edges(std::vector<LocalIndex>{0, 1, 2, 3}, 4), 6);
  EXPECT_EQ(count_edges(std::vector<LocalIndex>{0, 1, 2, 3, 4, 3, 2, 1}, 5), 9);
  EXPECT_EQ(count_edges(std::vector<LocalIndex>{0, 1, 2, 3, 3, 6, 5, 4}, 7), 12);
}

// Of the grid, of the diagonals of its squares, and of its cubes.
TEST(CountEdges, OfACubeOfCubes)
{
  const int n = 4;
  const CoarseMesh cube = testing::kuhn_cube(n);
  EXPECT_EQ(count_edges(cube.tet_vertices, cube.num_vertices()),
            3 * n * (n + 1) * (n + 1) + 3 * n * n * (n + 1) + n * n * n);
}

}  // namespace
}  // namespace tessera::mesh
