// SPDX-License-Identifier: BSD-3-Clause
#include "formats/cells.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <set>
#include <span>
#include <vector>

#include <gtest/gtest.h>

#include "tessera/base/vec3.hpp"
#include "tessera/layers/prism_tets.hpp"

#include "formats/joined_tets.hpp"
#include "formats/link/tets_behind.hpp"

namespace tessera::formats {
namespace {

constexpr std::array<Vec3, 5> kFloor{
    {{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {1.0, 1.0, 0.0}, {0.5, 2.0, 0.0}}};
using Names = std::array<LocalIndex, 5>;

// Puts a prism onto a triangle of the floor, which is seen from above; columns stand on the first
// three points.
void add_cell(const std::array<std::size_t, 3>& triangle, const Names& names, Piece& piece)
{
  std::array<std::size_t, 3> sorted = triangle;
  std::ranges::sort(sorted, {}, [&](std::size_t p) { return names[p]; });
  const auto first = std::ranges::find(triangle, sorted[0]) - triangle.begin();
  const bool is_outward = triangle[static_cast<std::size_t>(first + 1) % 3] == sorted[1];
  layers::Prism prism{};
  for (std::size_t c = 0; c < 3; ++c) {
    prism[c] = names[sorted[c]];
    prism[3 + c] = sorted[c] < 3 ? static_cast<LocalIndex>(5 + sorted[c]) : prism[c];
  }
  const LocalIndex cell = piece.num_cells();
  const LocalIndex num_tets = layers::append_prism_tets(prism, is_outward, piece.tet_points);
  piece.tet_cell.insert(piece.tet_cell.end(), at(num_tets), cell);
  piece.tet_material.insert(piece.tet_material.end(), at(num_tets), cell + 1);
}

// A prism, a pyramid and a tet side by side, whose whole outside is patch 1. Names of the points of
// the floor say how the prism and the pyramid are cut.
Piece three_cells(const Names& names)
{
  Piece piece;
  piece.point_xyz.resize(24);
  for (std::size_t p = 0; p < 8; ++p) {
    const Vec3 point = p < 5 ? kFloor[p] : kFloor[p - 5] + Vec3{0.0, 0.0, 1.0};
    std::ranges::copy(
        point, piece.point_xyz.begin() + (p < 5 ? 3 * names[p] : 3 * static_cast<LocalIndex>(p)));
  }
  piece.point_numbers.resize(8);
  std::iota(piece.point_numbers.begin(), piece.point_numbers.end(), 0);
  add_cell({0, 1, 2}, names, piece);
  add_cell({1, 3, 2}, names, piece);
  add_cell({2, 3, 4}, names, piece);
  const std::vector<LocalIndex> behind = tets_behind(8, piece.tet_points);
  for (LocalIndex side = 0; at(side) < behind.size(); ++side) {
    if (behind[at(side)] != kNoIndex) continue;
    const auto triangle = triangle_of_side(JoinedTets(piece), side);
    piece.triangle_side.push_back(side);
    piece.triangle_points.insert(piece.triangle_points.end(), triangle.begin(), triangle.end());
    piece.triangle_patch.push_back(1);
    piece.is_inner_triangle.push_back(0);
  }
  return piece;
}

double volume(const Piece& piece, std::span<const LocalIndex> cell,
              const std::vector<std::array<std::size_t, 4>>& tets)
{
  double sum = 0.0;
  for (const auto& tet : tets) {
    const auto point = [&](std::size_t c) {
      return point_at(std::span(piece.point_xyz), cell[tet[c]]);
    };
    sum += tet_volume(point(0), point(1), point(2), point(3));
  }
  return sum;
}

template <class Check>
void for_all_names(const Check& check)
{
  Names names{0, 1, 2, 3, 4};
  do {
    check(three_cells(names));
  } while (std::ranges::next_permutation(names).found);
}

TEST(PieceCells, HavePrismsPyramidsAndTetsThatArePositive)
{
  for_all_names([](const Piece& piece) {
    const PieceCells cells(piece);
    ASSERT_EQ(cells[Shape::tet].size(), 1U);
    ASSERT_EQ(cells[Shape::pyramid].size(), 1U);
    ASSERT_EQ(cells[Shape::prism].size(), 1U);
    EXPECT_EQ(cells[Shape::prism].tags[0], 1);
    EXPECT_EQ(cells[Shape::pyramid].tags[0], 2);
    EXPECT_EQ(cells[Shape::tet].tags[0], 3);
    EXPECT_NEAR(volume(piece, cells[Shape::tet].points, {{0, 1, 2, 3}}), 1.0 / 6.0, 1e-14);
    EXPECT_NEAR(volume(piece, cells[Shape::pyramid].points, {{0, 1, 2, 4}, {0, 2, 3, 4}}),
                1.0 / 3.0, 1e-14);
    const auto prism = cells[Shape::prism].points;
    EXPECT_NEAR(volume(piece, prism, {{0, 1, 2, 3}}), 1.0 / 6.0, 1e-14);
    EXPECT_NEAR(volume(piece, prism, {{0, 1, 2, 5}, {0, 1, 5, 4}, {0, 4, 5, 3}}), 0.5, 1e-14);
    for (std::size_t c = 0; c < 3; ++c) {
      const Vec3 up = point_at(std::span(piece.point_xyz), prism[3 + c])
                      - point_at(std::span(piece.point_xyz), prism[c]);
      EXPECT_NEAR(norm(up - Vec3{0.0, 0.0, 1.0}), 0.0, 1e-14);
    }
  });
}

std::set<LocalIndex> set_of(std::span<const LocalIndex> points)
{
  return {points.begin(), points.end()};
}

// As CellSide says.
std::set<LocalIndex> corners_of_side(const PieceCells& cells, const CellSide& side)
{
  const auto c = cells[side.cell.shape].of(at(side.cell.row));
  const std::size_t s = side.side;
  if (side.cell.shape == Shape::tet) {
    std::set<LocalIndex> others = set_of(c);
    others.erase(c[s]);
    return others;
  }
  if (side.cell.shape == Shape::pyramid)
    return s == 4 ? set_of(c.first(4)) : std::set<LocalIndex>{c[s], c[(s + 1) % 4], c[4]};
  if (s >= 3) return set_of(c.subspan(s == 3 ? 0 : 3, 3));
  return {c[s], c[(s + 1) % 3], c[3 + s], c[3 + (s + 1) % 3]};
}

TEST(PieceCells, HaveFacesThatAreSidesOfCells)
{
  for_all_names([](const Piece& piece) {
    const PieceCells cells(piece);
    ASSERT_EQ(cells[Shape::triangle].size(), 8U);
    ASSERT_EQ(cells[Shape::quad].size(), 2U);
    EXPECT_EQ(cells.patches().size(), 10U);
    for (std::size_t face = 0; face < 10; ++face) {
      const auto points =
          face < 8 ? cells[Shape::triangle].of(face) : cells[Shape::quad].of(face - 8);
      EXPECT_EQ(corners_of_side(cells, cells.side_of(face)), set_of(points));
    }
  });
}

TEST(PieceCells, AreClosed)
{
  for_all_names([](const Piece& piece) {
    const PieceCells cells(piece);
    Vec3 sum{};
    double volume = 0.0;
    for (const Shape shape : kFaceShapes) {
      for (std::size_t f = 0; f < cells[shape].size(); ++f) {
        const auto corners = cells[shape].of(f);
        const auto point = [&](std::size_t i) {
          return point_at(std::span(piece.point_xyz), corners[i]);
        };
        for (std::size_t i = 2; i < corners.size(); ++i) {
          const Vec3 area = 0.5 * cross(point(i - 1) - point(0), point(i) - point(0));
          sum = sum + area;
          volume += dot(area, point(0)) / 3.0;
        }
      }
    }
    EXPECT_NEAR(norm(sum), 0.0, 1e-13);
    EXPECT_NEAR(volume, 1.0, 1e-13);
  });
}

TEST(PieceCells, WithoutPrismsAreTheTets)
{
  Piece piece = three_cells({0, 1, 2, 3, 4});
  std::iota(piece.tet_cell.begin(), piece.tet_cell.end(), 0);
  const PieceCells cells(piece);
  EXPECT_EQ(cells[Shape::tet].size(), 6U);
  EXPECT_EQ(cells[Shape::tet].points.data(), piece.tet_points.data());
  EXPECT_EQ(cells[Shape::triangle].size(), piece.triangle_side.size());
  EXPECT_EQ(cells[Shape::prism].size() + cells[Shape::quad].size(), 0U);
}

TEST(PieceCells, GiveVtkPrismsWhoseFirstTriangleIsSeenFromOutside)
{
  std::vector<int> points;
  append_vtk_points<int>(Shape::prism, std::array{0, 1, 2, 3, 4, 5}, points);
  append_vtk_points<int>(Shape::pyramid, std::array{6, 7, 8, 9, 10}, points);
  EXPECT_EQ(points, (std::vector{0, 2, 1, 3, 5, 4, 6, 7, 8, 9, 10}));
}

TEST(JoinedTets, OfACellThatMakeNoPrismAreFound)
{
  Piece piece = three_cells({0, 1, 2, 3, 4});
  const auto defect = [&] { return std::string(defect_of_cell(JoinedTets(piece), {0, 3})); };
  EXPECT_EQ(defect(), "");
  std::swap_ranges(piece.tet_points.begin(), piece.tet_points.begin() + 4,
                   piece.tet_points.begin() + 4);
  EXPECT_NE(defect(), "");
}

}  // namespace
}  // namespace tessera::formats
