// SPDX-License-Identifier: BSD-3-Clause
#include "formats/foam/faces.hpp"

#include <array>
#include <map>
#include <numeric>
#include <span>

#include <gtest/gtest.h>

#include "tessera/base/vec3.hpp"
#include "tessera/layers/prism_tets.hpp"
#include "tessera/mesh/tet_topology.hpp"

#include "formats/link/tets_behind.hpp"

namespace tessera::formats {
namespace {

// A unit cube of two prisms, each of three tets; its whole outside is patch 1.
Piece cube_of_prisms()
{
  Piece piece;
  for (const double z : {0.0, 1.0}) {
    for (const auto& [x, y] : {std::pair{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}}) {
      piece.point_xyz.insert(piece.point_xyz.end(), {x, y, z});
    }
  }
  piece.point_numbers.resize(8);
  std::iota(piece.point_numbers.begin(), piece.point_numbers.end(), 0);
  layers::append_prism_tets({0, 1, 2, 4, 5, 6}, true, piece.tet_points);
  layers::append_prism_tets({0, 2, 3, 4, 6, 7}, true, piece.tet_points);
  piece.tet_material.assign(6, 1);
  piece.tet_cell = {0, 0, 0, 1, 1, 1};
  const std::vector<LocalIndex> behind = tets_behind(8, piece.tet_points);
  for (LocalIndex side = 0; side < 24; ++side) {
    if (behind[at(side)] != kNoIndex) continue;
    piece.triangle_side.push_back(side);
    piece.triangle_patch.push_back(1);
    piece.is_inner_triangle.push_back(0);
  }
  return piece;
}

Vec3 area_of(const Piece& piece, const FoamFace& face)
{
  const auto point = [&](std::size_t i) {
    return point_at(std::span(piece.point_xyz), face.corners()[i]);
  };
  Vec3 sum{};
  for (std::size_t i = 2; i < face.corners().size(); ++i) {
    sum = sum + 0.5 * cross(point(i - 1) - point(0), point(i) - point(0));
  }
  return sum;
}

TEST(FoamFaces, OfPrismsAreTrianglesAndQuads)
{
  const Piece cube = cube_of_prisms();
  const std::vector<FoamFace> inner = foam_inner_faces(cube, 10);
  ASSERT_EQ(inner.size(), 1U);
  EXPECT_EQ(inner[0].num_points, 4);
  EXPECT_EQ(inner[0].owner, 0);
  EXPECT_EQ(inner[0].neighbour, 11);
  EXPECT_EQ(inner[0].points[0], 0);
  EXPECT_NEAR(norm(area_of(cube, inner[0])), std::sqrt(2.0), 1e-12);
  const std::vector<FoamFace> outer = foam_patch_faces(cube, 1);
  EXPECT_EQ(std::ranges::count(outer, 3, &FoamFace::num_points), 4);
  EXPECT_EQ(std::ranges::count(outer, 4, &FoamFace::num_points), 4);
  EXPECT_TRUE(foam_patch_faces(cube, kNoPatchTag).empty());
  for (const FoamFace& face : outer) {
    EXPECT_NEAR(norm(area_of(cube, face)), face.num_points == 4 ? 1.0 : 0.5, 1e-12);
  }
}

TEST(FoamFaces, OfEveryCellAreClosed)
{
  const Piece cube = cube_of_prisms();
  std::array<Vec3, 2> sums{};
  for (const FoamFace& face : foam_patch_faces(cube, 1)) {
    sums[at(face.owner)] = sums[at(face.owner)] + area_of(cube, face);
  }
  const Vec3 between = area_of(cube, foam_inner_faces(cube, 0)[0]);
  EXPECT_NEAR(norm(sums[0] + between), 0.0, 1e-12);
  EXPECT_NEAR(norm(sums[1] - between), 0.0, 1e-12);
}

TEST(FoamFaces, AreCountedAsTheyAreWritten)
{
  const CellFaceCounts counts = count_cell_faces(cube_of_prisms(), 0, 1, 1);
  EXPECT_EQ(counts.inner.num_faces, 1);
  EXPECT_EQ(counts.inner.num_corners, 4);
  ASSERT_EQ(counts.of_patch.size(), 1U);
  EXPECT_EQ(counts.of_patch[0].num_faces, 8);
  EXPECT_EQ(counts.of_patch[0].num_corners, 28);
  ASSERT_EQ(counts.of_material.size(), 1U);
  EXPECT_EQ(counts.of_material[0].count, 2);
}

// Two pieces, each of one prism: both find the quad between them, beginning with the same point.
TEST(FoamFaces, BetweenPiecesAreTheSameOnBothSides)
{
  const Piece cube = cube_of_prisms();
  std::array<Piece, 2> pieces;
  const std::vector<LocalIndex> behind = tets_behind(8, cube.tet_points);
  for (LocalIndex p = 0; p < 2; ++p) {
    Piece& piece = pieces[at(p)];
    piece.number = p;
    piece.point_xyz = cube.point_xyz;
    piece.point_numbers = cube.point_numbers;
    const auto first = cube.tet_points.begin() + 12 * p;
    piece.tet_points.assign(first, first + 12);
    piece.tet_material.assign(3, 1);
    piece.tet_cell = {0, 0, 0};
    for (LocalIndex side = 0; side < 12; ++side) {
      const LocalIndex other = behind[at(12 * p + side)];
      if (other == kNoIndex || other / 3 == p) continue;
      piece.seams.push_back({side, 1 - p, other, 1 - p, kNoIndex});
    }
    ASSERT_EQ(piece.seams.size(), 2U);
  }
  const FoamFace low = foam_seam_faces(pieces[0], 0, 1).at(0);
  const FoamFace high = foam_seam_faces(pieces[1], 1, 0).at(0);
  EXPECT_EQ(low.num_points, 4);
  EXPECT_EQ(low.points[0], high.points[0]);
  EXPECT_EQ(low.points[1], high.points[3]);
  EXPECT_EQ(low.points[2], high.points[2]);
  EXPECT_EQ(foam_inner_faces(pieces[0], 0).size(), 1U);
  EXPECT_TRUE(foam_inner_faces(pieces[1], 1).empty());
}

}  // namespace
}  // namespace tessera::formats
