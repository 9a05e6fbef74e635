// SPDX-License-Identifier: BSD-3-Clause
#include "coarse/domains/octree_lattice.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <span>
#include <vector>

#include <gtest/gtest.h>

#include "tessera/base/error.hpp"

namespace tessera::coarse {
namespace {

LatticeSpace space_with(const std::function<double(const Vec3&)>& wanted_edge)
{
  const auto is_wanted_below = [wanted_edge](double edge, std::span<const Vec3> places) {
    return std::ranges::any_of(places, [&](const Vec3& p) { return wanted_edge(p) < edge; });
  };
  return {is_wanted_below, [](const Vec3& /*place*/, double /*distance*/) { return true; }};
}

std::vector<LatticePoint> lattice_of_one_size(const Box& box, double unit, double edge)
{
  return octree_lattice(box, unit, space_with([edge](const Vec3& /*place*/) { return edge; }));
}

double distance_to_nearest(const std::vector<LatticePoint>& points, std::size_t i)
{
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t j = 0; j < points.size(); ++j) {
    if (j != i) nearest = std::min(nearest, norm(points[j].xyz - points[i].xyz));
  }
  return nearest;
}

bool is_deep_in(const Box& box, const Vec3& p, double depth)
{
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (p[axis] < box.low[axis] + depth || p[axis] > box.high[axis] - depth) return false;
  }
  return true;
}

std::vector<Vec3> places_in(const std::vector<LatticePoint>& points, const Box& box)
{
  std::vector<Vec3> places;
  for (const LatticePoint& point : points) {
    if (is_deep_in(box, point.xyz, 0.0)) places.push_back(point.xyz);
  }
  return places;
}

// A tet between two neighbouring middles and an edge of a cell.
TEST(CellSide, GivesTheRootMeanSquareOfATet)
{
  const double side = cell_side(3.0);
  const double half_diagonal = 0.5 * std::sqrt(3.0) * side;
  EXPECT_NEAR((2.0 * side * side + 4.0 * half_diagonal * half_diagonal) / 6.0, 9.0, 1e-12);
}

TEST(OctreeLattice, OfOneSizeIsBodyCentred)
{
  const Box box{Vec3{0.3, -1.1, 2.0}, Vec3{8.7, 7.9, 9.6}};
  const double edge = 1.0 / cell_side(1.0);  // Cells have side 1.
  const std::vector<LatticePoint> points = lattice_of_one_size(box, 1.0, edge);
  int num_deep = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec3& p = points[i].xyz;
    for (const double c : p) EXPECT_EQ(2.0 * c, std::round(2.0 * c));
    EXPECT_NEAR(rms_edge(points[i].side), edge, 1e-12);
    if (!is_deep_in(box, p, 1.0)) continue;
    EXPECT_DOUBLE_EQ(distance_to_nearest(points, i), 0.5 * std::sqrt(3.0));
    const auto num_near = std::ranges::count_if(points, [&](const LatticePoint& other) {
      const double far = norm(other.xyz - p);
      return far > 0.0 && far < 1.01;
    });
    EXPECT_EQ(num_near, 8 + 6);
    ++num_deep;
  }
  EXPECT_GT(num_deep, 300);
}

TEST(OctreeLattice, CoversTheBox)
{
  const Box box{Vec3{-2.4, 0.1, 0.6}, Vec3{3.3, 5.2, 4.9}};
  const std::vector<LatticePoint> points = lattice_of_one_size(box, 1.0, 1.0 / cell_side(1.0));
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto place = [axis](const LatticePoint& point) { return point.xyz[axis]; };
    EXPECT_LE(std::ranges::min(points, {}, place).xyz[axis], box.low[axis]);
    EXPECT_GE(std::ranges::max(points, {}, place).xyz[axis], box.high[axis]);
  }
}

TEST(OctreeLattice, PlacesAscend)
{
  const std::vector<LatticePoint> points =
      lattice_of_one_size({Vec3{0, 0, 0}, Vec3{4, 4, 4}}, 1.0, 1.0 / cell_side(1.0));
  const auto place = [](const LatticePoint& point) { return point.xyz; };
  EXPECT_TRUE(std::ranges::is_sorted(points, std::ranges::less(), place));
  EXPECT_EQ(std::ranges::adjacent_find(points, std::ranges::equal_to(), place), points.end());
}

TEST(OctreeLattice, OneLatticeWhateverTheBox)
{
  const double edge = 0.7 / cell_side(1.0);
  const Box small{Vec3{1.3, 1.9, 2.2}, Vec3{4.1, 5.3, 4.4}};
  const Box large{Vec3{-7.7, -0.4, 1.1}, Vec3{6.0, 11.0, 5.0}};
  const auto in_small = places_in(lattice_of_one_size(small, 0.7, edge), small);
  EXPECT_FALSE(in_small.empty());
  EXPECT_EQ(in_small, places_in(lattice_of_one_size(large, 0.7, edge), small));
}

// Differences of places have few digits: the side is m / 256 times a power of two.
TEST(OctreeLattice, UnitIsRounded)
{
  const std::vector<LatticePoint> points =
      lattice_of_one_size({Vec3{0, 0, 0}, Vec3{3, 3, 3}}, 0.7123, 0.7123 / cell_side(1.0));
  for (const LatticePoint& point : points) {
    for (const double c : point.xyz) EXPECT_EQ(256.0 * c, std::round(256.0 * c));
  }
}

// Fine at the origin, coarse away from it.
double graded_edge(const Vec3& place) { return std::min(4.0, 0.25 + 0.3 * norm(place)); }

std::vector<LatticePoint> graded_lattice()
{
  return octree_lattice({{-8, -8, -8}, {8, 8, 8}}, cell_side(4.0), space_with(graded_edge));
}

TEST(OctreeLattice, SpacingFollowsWhatIsWanted)
{
  const std::vector<LatticePoint> points = graded_lattice();
  double finest = 1e9;
  double coarsest = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    finest = std::min(finest, rms_edge(points[i].side));
    coarsest = std::max(coarsest, rms_edge(points[i].side));
    // A cell is told by one of its places, at most half a diagonal away.
    EXPECT_LT(rms_edge(points[i].side),
              1.6 * (graded_edge(points[i].xyz) + 0.3 * rms_edge(points[i].side)));
    const double near = distance_to_nearest(points, i);
    EXPECT_GT(near, 0.3 * rms_edge(points[i].side));
    EXPECT_LT(near, 1.3 * rms_edge(points[i].side));
  }
  EXPECT_LT(finest, 0.5);
  EXPECT_GT(coarsest, 2.0);
}

TEST(OctreeLattice, NeighboursDifferByTwoAtMost)
{
  const std::vector<LatticePoint> points = graded_lattice();
  for (const LatticePoint& a : points) {
    for (const LatticePoint& b : points) {
      if (rms_edge(b.side) < 1.01 * rms_edge(a.side)
          && norm(a.xyz - b.xyz) < 0.6 * rms_edge(a.side)) {
        EXPECT_GT(rms_edge(b.side), 0.49 * rms_edge(a.side));
      }
    }
  }
}

TEST(OctreeLattice, TooManyCellsAreRefused)
{
  EXPECT_THROW((void)lattice_of_one_size({Vec3{0, 0, 0}, Vec3{1, 1, 1}}, 1e-5, 1e-5), MeshError);
}

}  // namespace
}  // namespace tessera::coarse
