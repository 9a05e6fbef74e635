// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <limits>

#include <gtest/gtest.h>

#include "support/meshes.hpp"

#include "check/piece/mesh.hpp"

namespace tessera::check {
namespace {

TEST(CellNumbers, GiveBackWhatTheyWereMadeOf)
{
  constexpr GlobalIndex kLeast = std::numeric_limits<GlobalIndex>::min();
  constexpr GlobalIndex kMost = std::numeric_limits<GlobalIndex>::max();
  const std::vector<std::vector<GlobalIndex>> lists{{},
                                                    {-3},
                                                    {7, 7, 7},
                                                    {5, 6, 7, 8},
                                                    {8, 6, 4},
                                                    {1, 2, 4},
                                                    {kLeast, kMost},
                                                    {kMost, kLeast},
                                                    {kLeast, kMost, kLeast},
                                                    {0, 0, 1}};
  for (const auto& list : lists) {
    const CellNumbers numbers(list);
    EXPECT_EQ(numbers.size(), list.size());
    EXPECT_EQ(numbers.to_vector(), list);
  }
  const std::vector<std::int32_t> subdomains{-1, std::numeric_limits<std::int32_t>::min()};
  EXPECT_EQ(CellNumbers(subdomains).to_vector(), subdomains);
}

TEST(CellNumbers, KnowWhetherTheyAreAllOne)
{
  using Ints = std::vector<std::int32_t>;
  EXPECT_TRUE(CellNumbers(Ints{}).is_constant());
  EXPECT_TRUE(CellNumbers(Ints{4}).is_constant());
  EXPECT_TRUE(CellNumbers(Ints{4, 4, 4}).is_constant());
  EXPECT_FALSE(CellNumbers(Ints{4, 5, 6}).is_constant());
  EXPECT_FALSE(CellNumbers(Ints{4, 4, 5}).is_constant());
}

mesh::MeshArrays arrays_of(const mesh::CoarseMesh& coarse)
{
  mesh::MeshArrays arrays;
  arrays.point_xyz = coarse.vertex_xyz.to_vector();
  arrays.cell_points.assign(coarse.tet_vertices.begin(), coarse.tet_vertices.end());
  return arrays;
}

TEST(PieceMesh, CornersOfSoundCellsStandInTheArraysAlone)
{
  Findings findings;
  const PieceMesh mesh =
      make_piece_mesh({0, false}, arrays_of(testing::kuhn_cube(2)), VertexIdentity::ids, findings);
  EXPECT_EQ(mesh.cell_vertices.capacity(), 0U);
  EXPECT_TRUE(findings.to_defects().empty());
}

TEST(PieceMesh, CellsAroundAFaultyOneKeepTheirCorners)
{
  mesh::MeshArrays arrays = arrays_of(testing::kuhn_cube(2));
  arrays.cell_points[4 * 5 + 2] = arrays.cell_points[4 * 5];
  for (std::size_t i = 0; i < 3; ++i) arrays.point_xyz.push_back(arrays.point_xyz[i]);
  const auto twin = static_cast<LocalIndex>(arrays.num_points()) - 1;
  std::vector<LocalIndex> expected = arrays.cell_points;
  std::fill_n(expected.begin() + 4 * 5, 4, kNoIndex);
  std::ranges::replace(arrays.cell_points, 0, twin);

  Findings findings;
  const PieceMesh mesh = make_piece_mesh({0, false}, arrays, VertexIdentity::ids, findings);
  EXPECT_EQ(mesh.cell_vertices, expected);
}

}  // namespace
}  // namespace tessera::check
