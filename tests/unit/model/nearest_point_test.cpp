// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/model/nearest_point.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "tessera/model/triangle_surface.hpp"

#include "support/stl_models.hpp"

namespace tessera::model {
namespace {

using Triangle = std::array<Vec3, 3>;

std::vector<Triangle> triangles_of(const TriangleSoup& soup)
{
  const TriangleSurface surface = check_surface(soup, "").surface;
  std::vector<Triangle> triangles;
  for (LocalIndex t = 0; t < surface.num_triangles(); ++t) triangles.push_back(surface.corners(t));
  return triangles;
}

std::vector<Vec3> random_points(int count, double half_side)
{
  std::mt19937 generator(5);
  std::uniform_real_distribution<double> coordinate(-half_side, half_side);
  std::vector<Vec3> points;
  for (int i = 0; i < count; ++i) {
    points.push_back({coordinate(generator), coordinate(generator), coordinate(generator)});
  }
  return points;
}

template <class Part>
NearestPoint by_looking_at_all(const std::vector<Part>& parts, const Vec3& point)
{
  NearestPoint best{{}, kNoIndex, std::numeric_limits<double>::infinity()};
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const Vec3 candidate = nearest_point_of(parts[i], point);
    const double squared_distance = dot(candidate - point, candidate - point);
    if (squared_distance < best.squared_distance) {
      best = {candidate, static_cast<LocalIndex>(i), squared_distance};
    }
  }
  return best;
}

template <class Part>
void expect_same_as_looking_at_all(const std::vector<Part>& parts, const std::vector<Vec3>& points)
{
  const NearestPointSearch<Part> search{std::span<const Part>(parts)};
  for (const Vec3& p : points) {
    const NearestPoint expected = by_looking_at_all(parts, p);
    const NearestPoint found = search.nearest(p);
    EXPECT_EQ(found.simplex, expected.simplex);
    EXPECT_EQ(found.xyz, expected.xyz);
  }
}

TEST(NearestPoint, OfATriangleIsNeverFartherThanAnySampleOfIt)
{
  const Triangle triangle{{{0, 0, 0}, {2, 0, 0}, {0.5, 1, 0.25}}};
  for (const Vec3& p : random_points(300, 3.0)) {
    const double distance = norm(nearest_point_of(triangle, p) - p);
    for (int i = 0; i <= 20; ++i) {
      for (int j = 0; i + j <= 20; ++j) {
        const Vec3 sample = (i / 20.0) * triangle[0] + (j / 20.0) * triangle[1]
                            + ((20 - i - j) / 20.0) * triangle[2];
        EXPECT_LE(distance, norm(sample - p) + 1e-14);
      }
    }
  }
}

TEST(NearestPoint, OfATriangleIsItselfForAPointOnIt)
{
  const Triangle triangle{{{0, 0, 0}, {2, 0, 0}, {0.5, 1, 0.25}}};
  for (const Vec3& corner : triangle) EXPECT_EQ(nearest_point_of(triangle, corner), corner);
  const Vec3 inside = (1.0 / 3.0) * (triangle[0] + triangle[1] + triangle[2]);
  EXPECT_LE(norm(nearest_point_of(triangle, inside) - inside), 1e-15);
}

using Tet = std::array<Vec3, 4>;

TEST(NearestPoint, OfATetIsThePointItselfInsideAndElseThatOfItsNearestSide)
{
  // Both orientations, and a flat one.
  for (const Tet& tet : {Tet{{{0, 0, 0}, {2, 0, 0}, {0.5, 1, 0.25}, {0.3, 0.2, 1.5}}},
                         Tet{{{2, 0, 0}, {0, 0, 0}, {0.5, 1, 0.25}, {0.3, 0.2, 1.5}}},
                         Tet{{{0, 0, 0}, {2, 0, 0}, {0, 1, 0}, {1, 1, 0}}}}) {
    const double volume = tet_volume(tet[0], tet[1], tet[2], tet[3]);
    int num_inside = 0;
    for (const Vec3& p : random_points(2000, 2.0)) {
      double nearest_side = std::numeric_limits<double>::infinity();
      bool is_inside = volume != 0.0;
      for (std::size_t i = 0; i < 4; ++i) {
        Tet replaced = tet;
        replaced[i] = p;
        const double part = tet_volume(replaced[0], replaced[1], replaced[2], replaced[3]);
        is_inside = is_inside && part * volume >= 0.0;
        const Triangle side{tet[(i + 1) % 4], tet[(i + 2) % 4], tet[(i + 3) % 4]};
        nearest_side = std::min(nearest_side, norm(nearest_point_of(side, p) - p));
      }
      num_inside += is_inside ? 1 : 0;
      const Vec3 nearest = nearest_point_of(tet, p);
      if (is_inside) {
        EXPECT_EQ(nearest, p);
      } else {
        EXPECT_NEAR(norm(nearest - p), nearest_side, 1e-14);
      }
    }
    EXPECT_EQ(num_inside > 0, volume != 0.0);
  }
}

TEST(NearestPoint, SearchOfTetsFindsTheLowestThatHoldsThePoint)
{
  std::vector<Tet> tets;  // Twelve that overlap, each of them twice.
  for (int copy = 0; copy < 2; ++copy) {
    for (int i = 0; i < 12; ++i) {
      const Vec3 corner{-1.0 + 0.2 * i, -0.5, -0.5};
      tets.push_back(
          {corner, corner + Vec3{1, 0, 0}, corner + Vec3{0, 1, 0.1}, corner + Vec3{0.3, 0.3, 1}});
    }
  }
  expect_same_as_looking_at_all(tets, random_points(2000, 1.5));
}

TEST(NearestPoint, SearchOfASphereFindsWhatLookingAtAllTrianglesFinds)
{
  expect_same_as_looking_at_all(triangles_of(testing::sphere_soup(3)), random_points(2000, 1.5));
}

TEST(NearestPoint, OfEquallyNearTrianglesTheLowestWins)
{
  const std::vector<Triangle> triangles = triangles_of(testing::cube_soup({-1, -1, -1}, 2.0));
  std::vector<Vec3> points = random_points(500, 1.5);
  points.push_back({0, 0, 0});  // equally near to all six sides
  for (const double s : {-2.0, -1.0, 0.0, 1.0, 2.0}) {
    points.push_back({s, s, s});
    points.push_back({s, s, 0});
  }
  expect_same_as_looking_at_all(triangles, points);
}

TEST(NearestPoint, SearchOfAPolylineFindsWhatLookingAtAllSegmentsFinds)
{
  std::vector<std::array<Vec3, 2>> helix;
  const auto at = [](int i) { return Vec3{std::cos(0.1 * i), std::sin(0.1 * i), 0.002 * i - 0.5}; };
  for (int i = 0; i < 500; ++i) helix.push_back({at(i), at(i + 1)});
  expect_same_as_looking_at_all(helix, random_points(2000, 1.5));
}

TEST(NearestPoint, DoesNotDependOnWhatWasAskedBefore)
{
  const std::vector<Triangle> triangles = triangles_of(testing::sphere_soup(2));
  const TriangleSearch search{std::span<const Triangle>(triangles)};
  const std::vector<Vec3> points = random_points(200, 1.5);
  std::vector<Vec3> first;
  for (const Vec3& p : points) first.push_back(search.nearest(p).xyz);
  for (std::size_t i = points.size(); i-- > 0;) EXPECT_EQ(search.nearest(points[i]).xyz, first[i]);
}

TEST(NearestPoint, IsNoneForAPointThatIsNotFinite)
{
  const std::vector<Triangle> triangles = triangles_of(testing::cube_soup());
  const TriangleSearch search{std::span<const Triangle>(triangles)};
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(search.nearest({nan, 0.0, 0.0}).simplex, kNoIndex);
}

}  // namespace
}  // namespace tessera::model
