// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/model/winding.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <vector>

#include <gtest/gtest.h>

#include "support/stl_models.hpp"

namespace tessera::model {
namespace {

using Corners = std::array<Vec3, 3>;

std::vector<Corners> triangles_of(const TriangleSoup& soup)
{
  std::vector<Corners> triangles;
  const std::span<const double> xyz(soup.corner_xyz);
  for (LocalIndex t = 0; t < soup.num_triangles(); ++t)
    triangles.push_back({point_at(xyz, 3 * t), point_at(xyz, 3 * t + 1), point_at(xyz, 3 * t + 2)});
  return triangles;
}

double exact(const std::vector<Corners>& triangles, const Vec3& p)
{
  double angle = 0.0;
  for (const Corners& corners : triangles) angle += solid_angle(corners, p);
  return angle / (4.0 * std::numbers::pi);
}

// Points in and around the unit ball, off its symmetries.
std::vector<Vec3> points()
{
  std::vector<Vec3> all;
  for (double x = -1.43; x < 1.5; x += 0.31) {
    for (double y = -1.47; y < 1.5; y += 0.31) {
      for (double z = -1.39; z < 1.5; z += 0.31) all.push_back({x, y, z});
    }
  }
  return all;
}

TEST(WindingNumbers, AreOneInAClosedSurfaceAndZeroAround)
{
  const WindingNumbers numbers(triangles_of(testing::sphere_soup(4)));
  for (const Vec3& p : points()) {
    if (std::abs(norm(p) - 1.0) < 0.02) continue;
    EXPECT_NEAR(numbers.at(p), norm(p) < 1.0 ? 1.0 : 0.0, 0.015) << norm(p);
  }
}

TEST(WindingNumbers, AreTheSumOfSolidAnglesWhereThereAreHoles)
{
  std::vector<Corners> triangles = triangles_of(testing::sphere_soup(4));
  std::erase_if(triangles, [](const Corners& p) { return p[0][2] > 0.3 && p[0][0] > -0.2; });
  const WindingNumbers numbers(triangles);
  double largest = 0.0;
  double largest_near_half = 0.0;
  int num_near_half = 0;
  for (const Vec3& p : points()) {
    const double right = exact(triangles, p);
    const double error = std::abs(numbers.at(p) - right);
    largest = std::max(largest, error);
    if (std::abs(right - 0.5) > 0.02) continue;
    largest_near_half = std::max(largest_near_half, error);
    ++num_near_half;
  }
  EXPECT_LT(largest, 0.015);
  EXPECT_LT(largest_near_half, 1e-3);
  EXPECT_GE(num_near_half, 3);
}

TEST(WindingNumbers, CountBodiesThatHoldAPoint)
{
  const WindingNumbers numbers(
      triangles_of(testing::joined(testing::cube_soup(), testing::cube_soup({0.5, 0.5, 0.5}))));
  EXPECT_NEAR(numbers.at({0.75, 0.7, 0.8}), 2.0, 1e-2);
  EXPECT_NEAR(numbers.at({0.25, 0.2, 0.3}), 1.0, 1e-2);
}

}  // namespace
}  // namespace tessera::model
