// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/delaunay/tetrahedralize.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <set>
#include <span>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tessera/base/error.hpp"
#include "tessera/base/vec3.hpp"
#include "tessera/delaunay/predicates.hpp"

#include "support/random_points.hpp"

namespace tessera::delaunay {
namespace {

using Points = std::vector<double>;

Vec3 place(const Points& xyz, LocalIndex v) { return point_at(std::span(xyz), v); }

void add(Points& xyz, const Vec3& p) { xyz.insert(xyz.end(), p.begin(), p.end()); }

// n^3 points; with the middles of cells a body-centred lattice.
Points grid(int n, double spacing, bool with_middles)
{
  Points xyz;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      for (int k = 0; k < n; ++k) {
        add(xyz, {i * spacing, j * spacing, k * spacing});
        if (with_middles) {
          add(xyz, {(i + 0.5) * spacing, (j + 0.5) * spacing, (k + 0.5) * spacing});
        }
      }
    }
  }
  return xyz;
}

// Permutations of four lengths with all signs, so exactly on one sphere.
Points exactly_on_sphere()
{
  Points xyz;
  for (Vec3 p : {Vec3{0.1, 0.2, 0.7}, Vec3{0.1, 0.7, 0.2}, Vec3{0.2, 0.1, 0.7}, Vec3{0.2, 0.7, 0.1},
                 Vec3{0.7, 0.1, 0.2}, Vec3{0.7, 0.2, 0.1}}) {
    for (unsigned signs = 0; signs < 8; ++signs) {
      add(xyz, {(signs & 1U) != 0 ? -p[0] : p[0], (signs & 2U) != 0 ? -p[1] : p[1],
                (signs & 4U) != 0 ? -p[2] : p[2]});
    }
  }
  return xyz;
}

double volume_of(const Points& xyz, const Tetrahedralization& tets)
{
  double sum = 0.0;
  for (std::size_t i = 0; i < tets.tet_vertices.size(); i += 4) {
    const LocalIndex* v = &tets.tet_vertices[i];
    sum += tet_volume(place(xyz, v[0]), place(xyz, v[1]), place(xyz, v[2]), place(xyz, v[3]));
  }
  return sum;
}

// Signs of all points beyond a face, and of the vertex across it: what makes a mesh of neighbours
// the one Delaunay mesh of the convex hull.
void expect_face(const Points& xyz, const Tetrahedralization& tets, LocalIndex corner,
                 bool test_hull)
{
  const LocalIndex* v = &tets.tet_vertices[at(corner & ~3)];
  std::array<Vec3, 4> p{place(xyz, v[0]), place(xyz, v[1]), place(xyz, v[2]), place(xyz, v[3])};
  const LocalIndex across = tets.tet_neighbours[at(corner)];
  if (across != kNoIndex) {
    ASSERT_EQ(tets.tet_neighbours[at(across)], corner);
    const Vec3 opposite = place(xyz, tets.tet_vertices[at(across)]);
    ASSERT_EQ(insphere_untied(p[0], p[1], p[2], p[3], opposite), -1);
    p[at(corner & 3)] = opposite;
    ASSERT_EQ(orient3d(p[0], p[1], p[2], p[3]), -1);
  } else if (test_hull) {
    for (std::size_t q = 0; q < xyz.size() / 3; ++q) {
      p[at(corner & 3)] = place(xyz, static_cast<LocalIndex>(q));
      ASSERT_GE(orient3d(p[0], p[1], p[2], p[3]), 0);
    }
  }
}

// @param[in] num_different Points at different places.
void expect_delaunay(const Points& xyz, const Tetrahedralization& tets, std::size_t num_different)
{
  ASSERT_GT(tets.num_tets(), 0);
  ASSERT_EQ(tets.tet_neighbours.size(), tets.tet_vertices.size());
  const std::set<LocalIndex> used(tets.tet_vertices.begin(), tets.tet_vertices.end());
  EXPECT_EQ(used.size(), num_different);
  for (LocalIndex t = 0; t < tets.num_tets(); ++t) {
    const LocalIndex* v = &tets.tet_vertices[4 * at(t)];
    ASSERT_EQ(orient3d(place(xyz, v[0]), place(xyz, v[1]), place(xyz, v[2]), place(xyz, v[3])), 1);
    for (LocalIndex corner = 4 * t; corner < 4 * t + 4; ++corner) {
      expect_face(xyz, tets, corner, xyz.size() < 3000);
    }
  }
}

void expect_delaunay(const Points& xyz)
{
  expect_delaunay(xyz, tetrahedralize(xyz), xyz.size() / 3);
}

// The tets as positions, in the order they come in.
std::vector<double> places_of(const Points& xyz, const Tetrahedralization& tets)
{
  std::vector<double> places;
  for (const LocalIndex v : tets.tet_vertices) add(places, place(xyz, v));
  return places;
}

Points shuffled(const Points& xyz, unsigned seed)
{
  std::vector<LocalIndex> order(xyz.size() / 3);
  std::iota(order.begin(), order.end(), 0);
  std::mt19937 engine(seed);
  std::ranges::shuffle(order, engine);
  Points result;
  for (const LocalIndex v : order) add(result, place(xyz, v));
  return result;
}

std::string error_of(const Points& xyz)
{
  try {
    static_cast<void>(tetrahedralize(xyz));
  } catch (const MeshError& error) {
    return error.what();
  }
  return "none";
}

TEST(Tetrahedralize, MakesOneTetOfFourPoints)
{
  const Points xyz{0, 0, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1};
  const Tetrahedralization tets = tetrahedralize(xyz);
  ASSERT_EQ(tets.num_tets(), 1);
  EXPECT_EQ(tets.tet_neighbours, std::vector<LocalIndex>(4, kNoIndex));
  expect_delaunay(xyz);
}

TEST(Tetrahedralize, IsDelaunayForRandomPoints)
{
  for (int i = 1; i < 20; ++i) {
    expect_delaunay(testing::points_in_cube(5 + 40 * i, static_cast<unsigned>(i)));
  }
  expect_delaunay(testing::points_in_cube(20'000));
}

TEST(Tetrahedralize, IsDelaunayWhereManyPointsLieOnOneSphere)
{
  expect_delaunay(grid(7, 1.0, false));
  expect_delaunay(grid(6, 0.375, true));
  expect_delaunay(grid(6, 0.1, true));  // Nearly: coordinates are rounded.
  expect_delaunay(exactly_on_sphere());
  expect_delaunay(testing::points_on_sphere(700));
}

TEST(Tetrahedralize, FillsTheConvexHull)
{
  const Points cubes = grid(9, 0.25, false);
  EXPECT_NEAR(volume_of(cubes, tetrahedralize(cubes)), 8.0, 1e-12);
  Points box = testing::points_in_cube(300);
  for (const double x : {-1.0, 1.0}) {
    for (const double y : {-1.0, 1.0}) {
      for (const double z : {-1.0, 1.0}) add(box, {x, y, z});
    }
  }
  expect_delaunay(box);
  EXPECT_NEAR(volume_of(box, tetrahedralize(box)), 8.0, 1e-12);
}

TEST(Tetrahedralize, TakesManyPointsOnOnePlaneOfTheHull)
{
  Points xyz = testing::points_in_cube(400);
  for (std::size_t i = 2; i < xyz.size(); i += 3) xyz[i] = 0.25;
  add(xyz, {0.1, 0.2, 1.0});
  expect_delaunay(xyz);
}

TEST(Tetrahedralize, IsAFunctionOfTheSetOfPoints)
{
  const std::array<Points, 4> samples{testing::points_in_cube(2000), grid(6, 1.0, false),
                                      grid(5, 0.375, true), exactly_on_sphere()};
  for (const Points& xyz : samples) {
    const std::vector<double> places = places_of(xyz, tetrahedralize(xyz));
    for (unsigned seed = 1; seed < 5; ++seed) {
      const Points other = shuffled(xyz, seed);
      ASSERT_NE(other, xyz);
      EXPECT_EQ(places_of(other, tetrahedralize(other)), places);
    }
  }
}

TEST(Tetrahedralize, TakesTheFirstOfEqualPoints)
{
  const Points once = testing::points_in_cube(200);
  Points twice = once;
  for (std::size_t i = 0; i < once.size(); ++i) twice.push_back(once[i]);
  add(twice, {0.0, -0.0, 0.0});
  add(twice, {-0.0, 0.0, 0.0});
  const Tetrahedralization tets = tetrahedralize(twice);
  expect_delaunay(twice, tets, 201);
  EXPECT_EQ(*std::ranges::max_element(tets.tet_vertices), 400);
  EXPECT_EQ(std::ranges::count_if(tets.tet_vertices, [](auto v) { return v >= 200 && v < 400; }),
            0);
}

TEST(Tetrahedralize, RefusesPointsOnOnePlane)
{
  EXPECT_EQ(error_of({}), "no tets: all 0 points lie on one plane");
  EXPECT_EQ(error_of({1, 2, 3}), "no tets: all 1 points lie on one plane");
  EXPECT_EQ(error_of({0, 0, 0, 1, 1, 1, 2, 2, 2, 5, 5, 5}),
            "no tets: all 4 points lie on one plane");
  Points plane = testing::points_in_cube(100);
  for (std::size_t i = 0; i < plane.size(); i += 3) plane[i] = plane[i + 1];
  EXPECT_EQ(error_of(plane), "no tets: all 100 points lie on one plane");
  plane[0] = std::nextafter(plane[0], 2.0);
  expect_delaunay(plane);
}

TEST(Tetrahedralize, RefusesCoordinatesThatNoTestIsExactFor)
{
  Points xyz = testing::points_in_cube(10);
  for (const double x : {std::numeric_limits<double>::quiet_NaN(), 1e200, -1e-200,
                         std::numeric_limits<double>::infinity()}) {
    xyz[4] = x;
    EXPECT_NE(error_of(xyz).find("point 1 has the coordinate"), std::string::npos);
  }
  xyz[4] = 0.0;
  expect_delaunay(xyz);
}

}  // namespace
}  // namespace tessera::delaunay
