// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/mesh/triangle_grading.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <set>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace tessera::mesh {
namespace {

using lattice::TrianglePoint;
using Point = std::pair<LocalIndex, LocalIndex>;

// Every way in which the sides of a triangle can be finer, with the sides in every order.
std::vector<TriangleGrading> all_gradings()
{
  std::vector<TriangleGrading> gradings;
  for (int level = 0; level <= 2; ++level) {
    for (unsigned finer = 0; finer < 7; ++finer) {
      SideOrder order{0, 1, 2};
      do gradings.push_back({level, finer, order});
      while (std::ranges::next_permutation(order).found);
    }
  }
  return gradings;
}

LocalIndex twice_area(const TrianglePoint& a, const TrianglePoint& b, const TrianglePoint& c)
{
  return (b.i - a.i) * (c.j - a.j) - (b.j - a.j) * (c.i - a.i);
}

class SplitTriangle : public ::testing::TestWithParam<LocalIndex> {};

TEST_P(SplitTriangle, IsFilledByTriangles)
{
  const LocalIndex parts = GetParam();
  for (const TriangleGrading& grading : all_gradings()) {
    LocalIndex num_before = 0;
    for_each_graded_triangle(grading, [&](auto...) { ++num_before; });
    LocalIndex num_triangles = 0;
    LocalIndex area = 0;
    for_each_split_triangle(
        grading, parts,
        [&](const TrianglePoint& a, const TrianglePoint& b, const TrianglePoint& c) {
          ++num_triangles;
          EXPECT_GT(twice_area(a, b, c), 0);
          area += twice_area(a, b, c);
        });
    const LocalIndex n = parts * grading.finest_intervals();
    EXPECT_EQ(num_triangles, num_before * parts * parts);
    EXPECT_EQ(area, n * n);
  }
}

TEST_P(SplitTriangle, HasDenselyNumberedPointsInside)
{
  const LocalIndex parts = GetParam();
  for (const TriangleGrading& grading : all_gradings()) {
    const SplitPointNumbers numbers(grading, parts);
    const LocalIndex n = parts * grading.finest_intervals();
    std::set<Point> inside;  // By j, then i, as the places of a lattice are.
    const auto add = [&](const TrianglePoint& p) {
      if (lattice::place_of(n, p).part == lattice::PointPlace::Part::inside) {
        inside.emplace(p.j, p.i);
      }
    };
    for_each_split_triangle(
        grading, parts,
        [&](const TrianglePoint& a, const TrianglePoint& b, const TrianglePoint& c) {
          add(a);
          add(b);
          add(c);
        });
    EXPECT_EQ(num_inner_split_points(grading, parts), static_cast<LocalIndex>(inside.size()));
    LocalIndex expected = 0;
    for (const auto& [j, i] : inside) EXPECT_EQ(numbers.of({i, j}), expected++);
  }
}

TEST_P(SplitTriangle, IsALatticeWhereAllSidesAreAlike)
{
  const SplitPointNumbers numbers({.level = 1}, GetParam());
  const LocalIndex n = 2 * GetParam();
  for (LocalIndex index = 0; index < lattice::num_inner_triangle_points(n); ++index) {
    EXPECT_EQ(numbers.of(lattice::inner_triangle_point(n, index)), index);
  }
}

INSTANTIATE_TEST_SUITE_P(Parts, SplitTriangle, ::testing::Values(1, 2, 4));

TEST(PlaceOf, TellsCornersSidesAndInside)
{
  using Part = lattice::PointPlace::Part;
  constexpr LocalIndex n = 4;
  std::array<int, 3> found{};
  for (LocalIndex j = 0; j <= n; ++j) {
    for (LocalIndex i = 0; i + j <= n; ++i) {
      const auto place = lattice::place_of(n, {i, j});
      ++found[static_cast<std::size_t>(place.part)];
      if (place.part != Part::side) continue;
      const TrianglePoint p = lattice::side_point(n, place.row, place.steps);
      EXPECT_EQ(Point(p.i, p.j), Point(i, j));
    }
  }
  EXPECT_EQ(found, (std::array{3, 9, 3}));
}

}  // namespace
}  // namespace tessera::mesh
