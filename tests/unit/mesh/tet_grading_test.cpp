// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/mesh/tet_grading.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <random>
#include <set>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

#include "tessera/mesh/tet_children.hpp"
#include "tessera/mesh/triangle_grading.hpp"

namespace tessera::mesh {
namespace {

using lattice::TetPoint;
using lattice::TrianglePoint;
using Place = std::array<LocalIndex, 3>;

constexpr unsigned kAllEdges = 63;

// A tet with these levels; its order and its diagonal are chosen freely.
TetGrading grading_of(int level, unsigned finer, const TetEdgeOrder& order = {0, 1, 2, 3, 4, 5},
                      std::size_t diagonal = 0)
{
  std::array<int, 6> levels{};
  for (std::size_t e = 0; e < levels.size(); ++e) {
    levels[e] = level + static_cast<int>(finer >> e & 1U);
  }
  const std::array<Vec3, 4> corners{Vec3{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  TetGrading grading = TetGrading::of(corners, corners, {0, 1, 2, 3}, levels);
  grading.order = order;
  grading.diagonal = diagonal;
  return grading;
}

std::vector<TetEdgeOrder> some_orders(std::size_t num_orders)
{
  TetEdgeOrder order{0, 1, 2, 3, 4, 5};
  std::vector<TetEdgeOrder> orders;
  if (num_orders >= 720) {
    do orders.push_back(order);
    while (std::ranges::next_permutation(order).found);
    return orders;
  }
  std::mt19937 random(7);
  while (orders.size() < num_orders) {
    std::ranges::shuffle(order, random);
    orders.push_back(order);
  }
  return orders;
}

// Both octahedra that five marks leave free are tried.
DiagonalLengths any_length(const ChildCorners& child)
{
  return {1.0, (child[0].i + child[0].j) % 4 == 0 ? 0.5 : 2.0, child[0].k % 4 == 0 ? 3.0 : 0.25};
}

TEST(NumChildren, IsWhatEnumerationFinds)
{
  constexpr std::array<std::size_t, 5> kNumOrders{720, 720, 60, 12, 3};
  for (int level = 0; level < 5; ++level) {
    for (const TetEdgeOrder& order : some_orders(kNumOrders[at(level)])) {
      for (unsigned finer = 0; finer < kAllEdges; ++finer) {
        const std::size_t diagonal = (finer + order[0]) % 3;
        const TetGrading grading = grading_of(level, finer, order, diagonal);
        GlobalIndex count = 0;
        for_each_graded_child(grading, any_length, [&](const auto&... /*points*/) { ++count; });
        ASSERT_EQ(num_children(grading), count) << finer << " at level " << level;
      }
    }
  }
}

TEST(NumChildren, CountsBeyond32Bits)
{
  const GlobalIndex n = 1024;
  EXPECT_EQ(num_children(grading_of(10, 0)), n * n * n);
  EXPECT_EQ(num_children(grading_of(9, 1)), n * n * n / 8 + n / 2);
  EXPECT_GT(num_children(grading_of(9, 62)), n * n * n / 8 + 2 * n * n - n - n);
}

LocalIndex volume_of(const TetPoint& a, const TetPoint& b, const TetPoint& c, const TetPoint& d)
{
  const auto edge = [&](const TetPoint& p) { return Place{p.i - a.i, p.j - a.j, p.k - a.k}; };
  const auto [u, v, w] = std::array{edge(b), edge(c), edge(d)};
  return u[0] * (v[1] * w[2] - v[2] * w[1]) - u[1] * (v[0] * w[2] - v[2] * w[0])
         + u[2] * (v[0] * w[1] - v[1] * w[0]);
}

Place place_of(const TetPoint& p) { return {p.i, p.j, p.k}; }

using Triangle = std::array<Place, 3>;

Triangle turned(Triangle triangle)
{
  std::rotate(triangle.begin(), std::ranges::min_element(triangle), triangle.end());
  return triangle;
}

struct Children {
  GlobalIndex volume = 0;     // In sixths of a cell of the lattice.
  std::set<Triangle> open{};  // Faces without a mirror.
  std::set<Place> points{};
};

Children children_of(const TetGrading& grading)
{
  Children found;
  for_each_graded_child(
      grading, any_length,
      [&](const TetPoint& a, const TetPoint& b, const TetPoint& c, const TetPoint& d) {
        EXPECT_GT(volume_of(a, b, c, d), 0);
        found.volume += volume_of(a, b, c, d);
        const std::array corners{place_of(a), place_of(b), place_of(c), place_of(d)};
        found.points.insert(corners.begin(), corners.end());
        for (const auto& [p, q, r] : kTetFaceCorners) {
          const Triangle face = turned({corners[p], corners[q], corners[r]});
          const Triangle mirror = turned({corners[p], corners[r], corners[q]});
          if (found.open.erase(mirror) != 0) continue;
          EXPECT_TRUE(found.open.insert(face).second);
        }
      });
  return found;
}

// A face of a tet as the skeleton sees it: by the levels and the order of its sides.
std::set<Triangle> triangles_of_face(const TetGrading& grading, std::size_t face)
{
  const auto& corners = kTetFaceCorners[face];
  std::array<EdgeRank, 3> ranks;
  std::array<int, 3> levels{};
  constexpr std::array<std::array<std::size_t, 2>, 3> kSides{{{0, 1}, {0, 2}, {1, 2}}};
  for (std::size_t s = 0; s < 3; ++s) {
    const std::size_t a = corners[kSides[s][0]];
    const std::size_t b = corners[kSides[s][1]];
    const auto e = static_cast<std::size_t>(
        std::ranges::find(kTetEdgeCorners, std::array{std::min(a, b), std::max(a, b)})
        - kTetEdgeCorners.begin());
    ranks[s].squared_length = -static_cast<double>(grading.order[e]);
    levels[s] = grading.level + static_cast<int>(grading.finer >> e & 1U);
  }
  const TriangleGrading of_face = TriangleGrading::of(ranks, levels);
  const LocalIndex n = of_face.finest_intervals();
  const LocalIndex step = 2 * grading.intervals() / n;
  const auto in_tet = [&](const TrianglePoint& p) {
    std::array<LocalIndex, 4> weights{};
    weights[corners[0]] = step * (n - p.i - p.j);
    weights[corners[1]] = step * p.i;
    weights[corners[2]] = step * p.j;
    return Place{weights[1], weights[2], weights[3]};
  };
  std::set<Triangle> triangles;
  for_each_graded_triangle(
      of_face, [&](const TrianglePoint& a, const TrianglePoint& b, const TrianglePoint& c) {
        EXPECT_TRUE(triangles.insert(turned({in_tet(a), in_tet(b), in_tet(c)})).second);
      });
  return triangles;
}

// Those of its own lattice, of finer edges and of faces whose sides are all finer.
std::set<Place> points_of(const TetGrading& grading)
{
  std::set<Place> points;
  const LocalIndex n = 2 * grading.intervals();
  for (LocalIndex k = 0; k <= n; ++k) {
    for (LocalIndex j = 0; j + k <= n; ++j) {
      for (LocalIndex i = 0; i + j + k <= n; ++i) {
        const std::array weights{n - i - j - k, i, j, k};
        unsigned finer_edges = 0;
        int num_corners = 0;
        for (std::size_t c = 0; c < 4; ++c) num_corners += weights[c] != 0 ? 1 : 0;
        for (std::size_t e = 0; e < 6; ++e) {
          const auto [a, b] = kTetEdgeCorners[e];
          const bool is_spanned = weights[a] != 0 && weights[b] != 0;
          finer_edges += is_spanned ? grading.finer >> e & 1U : 0U;
        }
        const bool is_old = i % 2 == 0 && j % 2 == 0 && k % 2 == 0;
        const bool is_finer =
            (num_corners == 2 && finer_edges == 1) || (num_corners == 3 && finer_edges == 3);
        if (is_old || is_finer) points.insert({i, j, k});
      }
    }
  }
  return points;
}

TEST(GradedChildren, FillTheTetAndShowWhatEachFaceAsksFor)
{
  constexpr std::array<std::size_t, 3> kNumOrders{40, 12, 4};
  for (int level = 0; level < 3; ++level) {
    const GlobalIndex n = 2 * lattice::intervals(level);
    for (const TetEdgeOrder& order : some_orders(kNumOrders[at(level)])) {
      for (unsigned finer = 0; finer < kAllEdges; ++finer) {
        const TetGrading grading = grading_of(level, finer, order, (finer + order[1]) % 3);
        const Children found = children_of(grading);
        EXPECT_EQ(found.volume, n * n * n);
        EXPECT_EQ(found.points, points_of(grading)) << finer << " at level " << level;
        std::set<Triangle> skin;
        for (std::size_t face = 0; face < 4; ++face) skin.merge(triangles_of_face(grading, face));
        ASSERT_EQ(found.open, skin) << finer << " at level " << level;
      }
    }
  }
}

TEST(TetGrading, TakesTheSmallestLevelAndTheLongestEdgeFirst)
{
  const std::array<Vec3, 4> corners{Vec3{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {0, 0, 3}};
  const TetGrading grading = TetGrading::of(corners, corners, {0, 1, 2, 3}, {3, 4, 3, 3, 4, 3});
  EXPECT_EQ(grading.level, 3);
  EXPECT_EQ(grading.finer, 0b010010U);
  EXPECT_EQ(grading.order, (TetEdgeOrder{5, 4, 2, 3, 1, 0}));  // 1, 4, 9, 5, 10, 13.
  EXPECT_TRUE(TetGrading::of(corners, corners, {0, 1, 2, 3}, {4, 4, 4, 4, 4, 4}).is_uniform());
  EXPECT_EQ(TetGrading::of(corners, corners, {0, 1, 2, 3}, {4, 4, 4, 4, 4, 4}).level, 4);
}

// All lengths of a regular tet are the same: the vertices decide, wherever they stand in the tet.
TEST(TetGrading, TiesAreBrokenByTheVertices)
{
  const std::array<Vec3, 4> places{Vec3{0, 0, 0}, {1, 1, 0}, {1, 0, 1}, {0, 1, 1}};
  std::array<LocalIndex, 4> vertices{3, 7, 11, 20};
  int num_turns = 0;
  do {
    const TetGrading grading = TetGrading::of(places, places, vertices, {0, 1, 1, 1, 1, 0});
    std::map<std::tuple<LocalIndex, LocalIndex>, std::uint8_t> place_of_edge;
    for (std::size_t e = 0; e < 6; ++e) {
      const auto [a, b] = kTetEdgeCorners[e];
      place_of_edge[std::minmax(vertices[a], vertices[b])] = grading.order[e];
    }
    std::uint8_t expected = 0;
    for (const auto& [edge, place] : place_of_edge) EXPECT_EQ(place, expected++);
    ++num_turns;
  } while (std::ranges::next_permutation(vertices).found);
  EXPECT_EQ(num_turns, 24);
}

TEST(EdgeRank, IsTheSameFromBothEnds)
{
  const Vec3 p{0.1, 0.7, 1e-17};
  const Vec3 q{1.0 / 3.0, -4.0, 1e5};
  const EdgeRank one = edge_rank({4, 9}, {p, q});
  const EdgeRank other = edge_rank({9, 4}, {q, p});
  EXPECT_EQ(one.squared_length, other.squared_length);
  EXPECT_EQ(one.vertices, other.vertices);
  EXPECT_FALSE(one < other || other < one);
}

}  // namespace
}  // namespace tessera::mesh
