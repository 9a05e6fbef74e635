// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/base/cheapest_triangulation.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <set>
#include <utility>

#include <gtest/gtest.h>

namespace tessera {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Without any order in it.
double cost_of(std::size_t i, std::size_t j, std::size_t k)
{
  return 1.0 + std::sin(static_cast<double>(7 * i + 31 * j + 101 * k));
}

bool any_chord(std::size_t /*i*/, std::size_t /*k*/) { return true; }

double add_cost(double behind, std::size_t i, std::size_t j, std::size_t k)
{
  return behind + cost_of(i, j, k);
}

double cost_by_looking_at_all(std::size_t i, std::size_t k)
{
  if (k < i + 2) return 0.0;
  double least = kInfinity;
  for (std::size_t j = i + 1; j < k; ++j) {
    least = std::min(
        least, cost_by_looking_at_all(i, j) + cost_by_looking_at_all(j, k) + cost_of(i, j, k));
  }
  return least;
}

TEST(CheapestTriangulation, CostsAsMuchAsTheBestOfAll)
{
  for (std::size_t n = 3; n <= 8; ++n) {
    const CheapestTriangulation<8> fixed(n, any_chord, add_cost);
    const CheapestTriangulation<> any(n, any_chord, add_cost);
    EXPECT_NEAR(fixed.cost(), cost_by_looking_at_all(0, n - 1), 1e-12) << n << " corners";
    EXPECT_EQ(any.cost(), fixed.cost()) << n << " corners";
  }
}

TEST(CheapestTriangulation, HasTwoTrianglesLessThanCornersAndTheirCost)
{
  constexpr std::size_t kCorners = 7;
  const CheapestTriangulation<kCorners> triangulation(kCorners, any_chord, add_cost);
  std::set<std::pair<std::size_t, std::size_t>> chords;
  std::size_t num_triangles = 0;
  double cost = 0.0;
  triangulation.for_each_triangle([&](std::size_t i, std::size_t j, std::size_t k) {
    EXPECT_LT(i, j);
    EXPECT_LT(j, k);
    ++num_triangles;
    cost += cost_of(i, j, k);
    chords.insert({{i, j}, {j, k}, {i, k}});
  });
  EXPECT_EQ(num_triangles, kCorners - 2);
  EXPECT_EQ(chords.size(), 2 * kCorners - 3) << "edges of a triangulated polygon";
  EXPECT_NEAR(cost, triangulation.cost(), 1e-12);
}

TEST(CheapestTriangulation, LeavesOutForbiddenChords)
{
  const auto not_0_2 = [](std::size_t i, std::size_t k) { return i != 0 || k != 2; };
  const auto one_each = [](double behind, std::size_t, std::size_t, std::size_t) {
    return behind + 1.0;
  };
  const CheapestTriangulation<> triangulation(4, not_0_2, one_each);
  EXPECT_EQ(triangulation.cost(), 2.0);
  EXPECT_EQ(triangulation.apex(0, 3), 1U);
  const auto none = [](std::size_t, std::size_t) { return false; };
  EXPECT_EQ(CheapestTriangulation<>(4, none, one_each).cost(), kInfinity);
  EXPECT_EQ(CheapestTriangulation<>(3, none, one_each).cost(), 1.0) << "it has no chord";
}

}  // namespace
}  // namespace tessera
