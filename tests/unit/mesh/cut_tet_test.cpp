// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/mesh/cut_tet.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace tessera::mesh {
namespace {

constexpr unsigned kAllEdges = 63;
constexpr std::array<std::array<std::size_t, 2>, 3> kSides{{{0, 1}, {0, 2}, {1, 2}}};

using Point = std::array<int, 3>;
using Triangle = std::array<CutNode, 3>;  // Begins with its lowest node.

// Corners are twice the unit vectors, so midpoints are whole, too.
Point place_of(CutNode node)
{
  constexpr std::array<Point, 4> kCorners{{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2}}};
  if (node < 4) return kCorners[node];
  const auto [a, b] = kTetEdgeCorners[node - 4U];
  Point middle{};
  for (std::size_t i = 0; i < 3; ++i) middle[i] = (kCorners[a][i] + kCorners[b][i]) / 2;
  return middle;
}

// Six times the volume; 8 for the whole tet.
int volume_of(const std::array<CutNode, 4>& tet)
{
  std::array<Point, 3> m{};
  const Point origin = place_of(tet[0]);
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t i = 0; i < 3; ++i) m[row][i] = place_of(tet[row + 1])[i] - origin[i];
  }
  return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1])
         - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0])
         + m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

Triangle turned(Triangle triangle)
{
  std::rotate(triangle.begin(), std::ranges::min_element(triangle), triangle.end());
  return triangle;
}

Triangle mirrored(const Triangle& triangle)
{
  return turned({triangle[0], triangle[2], triangle[1]});
}

template <std::size_t N>
std::vector<std::array<std::uint8_t, N>> all_orders()
{
  std::array<std::uint8_t, N> order{};
  for (std::size_t i = 0; i < N; ++i) order[i] = static_cast<std::uint8_t>(i);
  std::vector<std::array<std::uint8_t, N>> orders;
  do orders.push_back(order);
  while (std::ranges::next_permutation(order).found);
  return orders;
}

std::size_t edge_between(std::size_t a, std::size_t b)
{
  std::size_t e = 0;
  while (std::min(a, b) != kTetEdgeCorners[e][0] || std::max(a, b) != kTetEdgeCorners[e][1]) {
    ++e;
  }
  return e;
}

// Faces that have no mirror among the tets.
std::set<Triangle> open_faces(const CutTets& tets)
{
  std::set<Triangle> open;
  for (const auto& tet : tets) {
    for (const auto& [a, b, c] : kTetFaceCorners) {
      const Triangle face = turned({tet[a], tet[b], tet[c]});
      if (open.erase(mirrored(face)) != 0) continue;
      EXPECT_TRUE(open.insert(face).second);
    }
  }
  return open;
}

// What cut_triangle() makes of the faces of a tet. Their corners come in any order: `turn` says in
// which.
std::set<Triangle> cut_faces(unsigned marks, const TetEdgeOrder& order,
                             const std::array<std::size_t, 3>& turn)
{
  std::set<Triangle> triangles;
  const bool is_even = (turn[0] < turn[1]) + (turn[1] < turn[2]) + (turn[2] < turn[0]) == 2;
  for (const auto& face : kTetFaceCorners) {
    const std::array corners{face[turn[0]], face[turn[1]], face[turn[2]]};
    std::array<CutNode, 6> nodes{};
    unsigned marked_sides = 0;
    SideOrder order_of_sides{};
    for (std::size_t s = 0; s < 3; ++s) {
      const std::size_t e = edge_between(corners[kSides[s][0]], corners[kSides[s][1]]);
      nodes[s] = static_cast<CutNode>(corners[s]);
      nodes[3 + s] = static_cast<CutNode>(4 + e);
      marked_sides |= (marks >> e & 1U) << s;
      order_of_sides[s] = order[e];
    }
    for (const auto& [p, q, r] : cut_triangle(marked_sides, order_of_sides)) {
      const Triangle triangle = turned({nodes[p], nodes[q], nodes[r]});
      triangles.insert(is_even ? triangle : mirrored(triangle));
    }
  }
  return triangles;
}

constexpr std::array<DiagonalLengths, 7> kDiagonals{
    {{0, 0, 0}, {1, 2, 3}, {1, 3, 2}, {2, 1, 3}, {2, 3, 1}, {3, 1, 2}, {3, 2, 1}}};

TEST(CutTet, FillsTheTetWhateverIsMarkedInWhateverOrder)
{
  for (const TetEdgeOrder& order : all_orders<6>()) {
    for (unsigned marks = 0; marks < kAllEdges; ++marks) {
      const std::set<Triangle> faces = cut_faces(marks, order, {0, 1, 2});
      for (const DiagonalLengths& diagonals : kDiagonals) {
        const CutTets tets = cut_tet(marks, order, diagonals);
        int volume = 0;
        unsigned used = 0;
        for (const auto& tet : tets) {
          ASSERT_GT(volume_of(tet), 0) << marks;
          volume += volume_of(tet);
          for (const CutNode node : tet) used |= 1U << node;
        }
        ASSERT_EQ(volume, 8) << marks;
        ASSERT_EQ(used, 15U | marks << 4) << "all corners, and the marked midpoints";
        ASSERT_EQ(open_faces(tets), faces) << marks;
        if (std::popcount(marks) < 5) break;  // Nothing else has a choice.
      }
    }
  }
}

// So two tets that show each other a face cut it alike.
TEST(CutTet, FacesAreTheSameFromAllSides)
{
  std::array<std::size_t, 3> turn{0, 1, 2};
  while (std::ranges::next_permutation(turn).found) {
    for (const TetEdgeOrder& order : all_orders<6>()) {
      for (unsigned marks = 0; marks < kAllEdges; ++marks) {
        ASSERT_EQ(cut_faces(marks, order, turn), cut_faces(marks, order, {0, 1, 2})) << marks;
      }
    }
  }
}

TEST(CutTet, OnlyTheOrderOfMarkedEdgesCounts)
{
  for (const TetEdgeOrder& order : all_orders<6>()) {
    for (unsigned marks = 0; marks < kAllEdges; ++marks) {
      TetEdgeOrder other = order;
      for (std::size_t e = 0; e < 6; ++e) {
        if ((marks >> e & 1U) == 0) other[e] = static_cast<std::uint8_t>(200 - e);
      }
      ASSERT_TRUE(std::ranges::equal(cut_tet(marks, order, {}), cut_tet(marks, other, {})));
    }
  }
}

// Between 01–23, 02–13 and 03–12, those that both end in marked midpoints.
TEST(CutTet, AnOctahedronIsCutAlongTheShorterOfTwoDiagonals)
{
  int num_octahedra = 0;
  for (const TetEdgeOrder& order : all_orders<6>()) {
    for (std::size_t unmarked = 0; unmarked < 6; ++unmarked) {
      const unsigned marks = kAllEdges & ~(1U << unmarked);
      std::array<bool, 3> follows_length{};
      const auto has_diagonal = [&](std::size_t d, const DiagonalLengths& lengths) {
        const CutTets tets = cut_tet(marks, order, lengths);
        return std::ranges::any_of(tets, [&](const auto& tet) {
          return std::ranges::count(tet, 4 + d) == 1 && std::ranges::count(tet, 9 - d) == 1;
        });
      };
      for (std::size_t d = 0; d < 3; ++d) {
        DiagonalLengths longest{1, 1, 1};
        DiagonalLengths shortest{2, 2, 2};
        longest[d] = 2;
        shortest[d] = 1;
        follows_length[d] = has_diagonal(d, shortest) && !has_diagonal(d, longest);
      }
      EXPECT_FALSE(follows_length[std::min(unmarked, 5 - unmarked)]) << "no such diagonal";
      const auto num_choices = std::ranges::count(follows_length, true);
      EXPECT_TRUE(num_choices == 0 || num_choices == 2);
      num_octahedra += num_choices == 2 ? 1 : 0;
    }
  }
  EXPECT_EQ(num_octahedra, 6 * 720 / 2);  // If both diagonals of the faces end in one corner.
}

// Twice the area of a triangle in the lattice with corners (0, 0), (2, 0), (0, 2).
int area_of(const Triangle& triangle)
{
  constexpr std::array<std::array<int, 2>, 6> kPlaces{
      {{0, 0}, {2, 0}, {0, 2}, {1, 0}, {0, 1}, {1, 1}}};
  const auto [a, b, c] = triangle;
  return (kPlaces[b][0] - kPlaces[a][0]) * (kPlaces[c][1] - kPlaces[a][1])
         - (kPlaces[b][1] - kPlaces[a][1]) * (kPlaces[c][0] - kPlaces[a][0]);
}

TEST(CutTriangle, HasTheAreaAndTheBoundaryOfTheTriangle)
{
  for (const SideOrder& order : all_orders<3>()) {
    for (unsigned marks = 0; marks < 8; ++marks) {
      const CutTriangles triangles = cut_triangle(marks, order);
      EXPECT_EQ(triangles.size(), 1U + static_cast<std::size_t>(std::popcount(marks)));
      int area = 0;
      std::set<std::pair<CutNode, CutNode>> open;
      for (const auto& triangle : triangles) {
        EXPECT_GT(area_of(triangle), 0) << marks;
        area += area_of(triangle);
        for (std::size_t i = 0; i < 3; ++i) {
          const std::pair edge{triangle[i], triangle[(i + 1) % 3]};
          if (open.erase({edge.second, edge.first}) != 0) continue;
          EXPECT_TRUE(open.insert(edge).second);
        }
      }
      EXPECT_EQ(area, 4);
      std::set<std::pair<CutNode, CutNode>> sides;
      for (const auto& [from, to, side] : {std::array<CutNode, 3>{0, 1, 0}, {2, 0, 1}, {1, 2, 2}}) {
        const auto middle = static_cast<CutNode>(3 + side);
        const bool is_marked = (marks >> side & 1U) != 0;
        sides.insert({from, is_marked ? middle : to});
        if (is_marked) sides.insert({middle, to});
      }
      EXPECT_EQ(open, sides) << marks;
    }
  }
}

TEST(CutTriangle, TheDiagonalGoesFromTheMiddleOfTheEarlierSide)
{
  for (const SideOrder& order : all_orders<3>()) {
    for (std::size_t unmarked = 0; unmarked < 3; ++unmarked) {
      const std::size_t one = (unmarked + 1) % 3;
      const std::size_t two = (unmarked + 2) % 3;
      const std::size_t earlier = order[one] < order[two] ? one : two;
      const auto middle = static_cast<CutNode>(3 + earlier);
      const auto opposite = static_cast<CutNode>(2 - earlier);
      int times = 0;
      for (const auto& triangle : cut_triangle(7U & ~(1U << unmarked), order)) {
        times += std::ranges::count(triangle, middle) * std::ranges::count(triangle, opposite) != 0;
      }
      EXPECT_EQ(times, 2) << "a diagonal has two sides";
    }
  }
}

}  // namespace
}  // namespace tessera::mesh
