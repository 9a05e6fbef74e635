// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>

#include <gtest/gtest.h>

#include "support/meshes.hpp"

#include "check/piece/topology.hpp"

namespace tessera::check {
namespace {

mesh::MeshArrays arrays_of(const mesh::CoarseMesh& coarse)
{
  mesh::MeshArrays arrays;
  arrays.point_xyz = coarse.vertex_xyz.to_vector();
  arrays.cell_points.assign(coarse.tet_vertices.begin(), coarse.tet_vertices.end());
  arrays.cell_ints["attribute"].assign(coarse.tet_material.begin(), coarse.tet_material.end());
  return arrays;
}

PieceTopology topology_of(const mesh::MeshArrays& arrays, Findings& findings)
{
  EdgeLengths lengths;
  const PieceMesh mesh = make_piece_mesh({0, false}, arrays, VertexIdentity::ids, findings);
  return analyse_topology(mesh, lengths, findings);
}

TEST(PieceTopology, CubeHasTheNumbersOfABall)
{
  for (const int n : {1, 2, 5}) {
    Findings findings;
    const mesh::CoarseMesh cube = testing::kuhn_cube(n);
    const PieceTopology topology = topology_of(arrays_of(cube), findings);
    EXPECT_TRUE(findings.to_defects().empty());
    EXPECT_EQ(topology.num_components, 1);
    const auto outside = std::count_if(
        topology.surface.begin(), topology.surface.end(), [&](const SurfaceTriangle& triangle) {
          Vec3 centre{};
          for (const LocalIndex v : triangle.vertices)
            centre = centre + (1.0 / 3.0) * cube.position(v);
          return *std::min_element(centre.begin(), centre.end()) < 1e-12
                 || *std::max_element(centre.begin(), centre.end()) > 1.0 - 1e-12;
        });
    EXPECT_EQ(outside, 12 * n * n);
    const auto num_shown =
        outside + (static_cast<GlobalIndex>(topology.surface.size()) - outside) / 2;
    EXPECT_EQ(cube.num_vertices() - topology.num_edges + topology.num_inner_triangles + num_shown
                  - cube.num_tets(),
              1);
  }
}

TEST(PieceTopology, BothSidesOfAnInterfaceAreShown)
{
  Findings findings;
  const mesh::CoarseMesh cube = testing::two_material_cube(4);
  const PieceTopology topology = topology_of(arrays_of(cube), findings);
  const auto at_interface = std::count_if(
      topology.surface.begin(), topology.surface.end(), [&](const SurfaceTriangle& triangle) {
        return std::all_of(triangle.vertices.begin(), triangle.vertices.end(),
                           [&](LocalIndex v) { return cube.position(v)[0] == 0.5; });
      });
  EXPECT_EQ(at_interface, 2 * 2 * 16);
}

TEST(PieceTopology, TetsThatTouchInAnEdgeAreTwoComponents)
{
  Findings findings;
  mesh::MeshArrays arrays = arrays_of(testing::kuhn_cube(1));
  // Tets of opposite orders of the axes share the diagonal only.
  const auto& all = arrays.cell_points;
  std::vector<LocalIndex> two(all.begin(), all.begin() + 4);
  for (std::size_t t = 1; t < 6 && two.size() == 4; ++t) {
    const auto tet = all.begin() + static_cast<std::ptrdiff_t>(4 * t);
    const auto num_shared = std::count_if(tet, tet + 4, [&](LocalIndex p) {
      return std::find(two.begin(), two.begin() + 4, p) != two.begin() + 4;
    });
    if (num_shared == 2) two.insert(two.end(), tet, tet + 4);
  }
  ASSERT_EQ(two.size(), 8U);
  arrays.cell_points = two;
  arrays.cell_ints["attribute"].resize(2);
  const PieceTopology topology = topology_of(arrays, findings);
  EXPECT_EQ(topology.num_components, 2);
  EXPECT_EQ(topology.num_edges, 11);
  EXPECT_EQ(findings.count(Kind::unused_point), 2);
}

TEST(PieceTopology, EveryOrderOfATriangleHasTheParityOfItsPermutation)
{
  std::array<int, 3> order{3, 5, 9};
  for (int turn = 0; turn < 3; ++turn) {
    EXPECT_FALSE(is_odd(order[0], order[1], order[2]));
    EXPECT_TRUE(is_odd(order[1], order[0], order[2]));
    std::rotate(order.begin(), order.begin() + 1, order.end());
  }
}

}  // namespace
}  // namespace tessera::check
