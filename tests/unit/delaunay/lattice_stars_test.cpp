// SPDX-License-Identifier: BSD-3-Clause
#include "delaunay/lattice_stars.hpp"

#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

#include "tessera/base/tet.hpp"
#include "tessera/base/vec3.hpp"
#include "tessera/delaunay/tetrahedralize.hpp"

#include "support/random_points.hpp"

namespace tessera::delaunay {
namespace {

// Points with what is said of the lattice that they are of.
struct Sample {
  std::vector<Vec3> points{};
  std::vector<double> side{};

  void add(const Vec3& point, double of_side)
  {
    points.push_back(point);
    side.push_back(of_side);
  }

  [[nodiscard]] std::vector<double> xyz() const
  {
    std::vector<double> values;
    for (const Vec3& point : points) values.insert(values.end(), point.begin(), point.end());
    return values;
  }

  [[nodiscard]] auto num_closed() const
  {
    return std::ranges::count(lattice_stars(points, side).is_closed, 1);
  }
};

// Corners and middles of cells, from `first` to `last` of them along each axis.
Sample lattice(double side, int first, int last)
{
  Sample sample;
  for (int i = first; i < last; ++i) {
    for (int j = first; j < last; ++j) {
      for (int k = first; k < last; ++k) {
        const Vec3 cell{side * i, side * j, side * k};
        sample.add(cell, side);
        sample.add(cell + Vec3{0.5 * side, 0.5 * side, 0.5 * side}, side);
      }
    }
  }
  return sample;
}

template <class Condition>
Sample without(const Sample& sample, const Condition& condition)
{
  Sample rest;
  for (std::size_t i = 0; i < sample.points.size(); ++i) {
    if (!condition(sample.points[i])) rest.add(sample.points[i], sample.side[i]);
  }
  return rest;
}

// What is known of the lattice changes nothing.
void expect_same_tets(const Sample& sample)
{
  const std::vector<double> xyz = sample.xyz();
  const Tetrahedralization alone = tetrahedralize(xyz);
  const Tetrahedralization with_stars = tetrahedralize(xyz, sample.side);
  EXPECT_EQ(with_stars.tet_vertices, alone.tet_vertices);
  EXPECT_EQ(with_stars.tet_neighbours, alone.tet_neighbours);
}

// Of 12 cells along each axis 10 middles have a cell on each side, and 9 corners two before them.
TEST(LatticeStars, CloseWhatIsDeepInALattice)
{
  const Sample sample = lattice(0.375, -5, 7);
  EXPECT_EQ(sample.num_closed(), 10 * 10 * 10 + 9 * 9 * 9);
  expect_same_tets(sample);
}

TEST(LatticeStars, HaveTheTwentyFourTetsOfEachPoint)
{
  const Sample sample = lattice(2.0, 0, 7);
  const LatticeStars stars = lattice_stars(sample.points, sample.side);
  const std::vector<double> xyz = sample.xyz();
  std::vector<int> num_tets(sample.points.size(), 0);
  for (std::size_t i = 0; i < stars.tet_vertices.size(); i += 4) {
    const auto corners = corners_at<4>(xyz, stars.tet_vertices, i / 4);
    EXPECT_NEAR(tet_volume(corners), 8.0 / 12.0, 1e-12);
    for (std::size_t c = 0; c < 4; ++c) ++num_tets[at(stars.tet_vertices[i + c])];
  }
  for (std::size_t i = 0; i < num_tets.size(); ++i) {
    if (stars.is_closed[i] == 0) continue;
    EXPECT_EQ(num_tets[i], 24);
  }
}

TEST(LatticeStars, StopWhereOtherPointsAre)
{
  Sample sample = lattice(0.25, -6, 6);
  const auto num_before = sample.num_closed();
  const std::vector<double> values = testing::points_in_cube(20);
  for (std::size_t i = 0; i < values.size(); i += 3) {
    sample.add({0.5 * values[i], 0.5 * values[i + 1], 0.5 * values[i + 2]}, 0.0);
  }
  EXPECT_LT(sample.num_closed(), num_before);
  expect_same_tets(sample);
}

TEST(LatticeStars, GoAroundHolesOfALattice)
{
  const Sample sample = without(lattice(0.25, -8, 8), [](const Vec3& point) {
    return norm(point) < 0.3 || norm(point - Vec3{1.0, 1.0, 0.9}) < 0.5;
  });
  EXPECT_GT(sample.num_closed(), 500);
  expect_same_tets(sample);
}

// A void that is closed by points around it, and one that touches the hull.
TEST(LatticeStars, OfTwoLatticesSideBySide)
{
  Sample sample = without(lattice(0.25, -8, 12), [](const Vec3& point) { return point[0] >= 0.0; });
  const Sample coarse =
      without(lattice(0.5, -4, 6), [](const Vec3& point) { return point[0] < 0.0; });
  for (std::size_t i = 0; i < coarse.points.size(); ++i) sample.add(coarse.points[i], 0.5);
  EXPECT_GT(sample.num_closed(), 1000);
  expect_same_tets(sample);
}

TEST(LatticeStars, DoNotTrustWhatTheyAreTold)
{
  Sample sample = lattice(0.1, -6, 6);  // Multiples are rounded: few are exact.
  expect_same_tets(sample);
  sample = lattice(0.25, -6, 6);
  for (std::size_t i = 0; i < sample.side.size(); i += 7) sample.side[i] = 0.125;
  expect_same_tets(sample);
  for (Vec3& point : sample.points) point[0] += 1e-3;
  EXPECT_EQ(sample.num_closed(), 0);
  expect_same_tets(sample);
  sample = lattice(0.25, 1 << 20, (1 << 20) + 6);
  EXPECT_EQ(sample.num_closed(), 0) << "too far from the origin to be numbered";
  expect_same_tets(sample);
}

// A point may be there twice; the first row stands for both.
TEST(LatticeStars, TakeEqualPoints)
{
  Sample sample = lattice(0.25, -4, 4);
  const std::size_t size = sample.points.size();
  for (std::size_t i = 0; i < size; i += 5) sample.add(sample.points[i], 0.0);
  expect_same_tets(sample);
}

}  // namespace
}  // namespace tessera::delaunay
