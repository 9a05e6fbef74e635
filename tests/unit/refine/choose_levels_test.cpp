// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/refine/choose_levels.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "tessera/mesh/coarse_edges.hpp"
#include "tessera/mesh/tet_topology.hpp"

#include "support/graded_meshes.hpp"
#include "support/meshes.hpp"

namespace tessera::refine {
namespace {

using mesh::CoarseMesh;
using mesh::EdgeLevels;

TEST(CoarseEdges, AreThoseOfTheTetsInOrder)
{
  const CoarseMesh coarse = testing::shuffled(testing::kuhn_cube(3), 5);
  std::set<std::array<LocalIndex, 2>> expected;
  for (LocalIndex t = 0; t < coarse.num_tets(); ++t) {
    for (const auto& [a, b] : mesh::kTetEdgeCorners) {
      const auto [low, high] = std::minmax(coarse.tet(t)[a], coarse.tet(t)[b]);
      expected.insert({low, high});
    }
  }
  std::vector<LocalIndex> flat;
  for (const auto& edge : expected) flat.insert(flat.end(), edge.begin(), edge.end());
  EXPECT_EQ(mesh::coarse_edges(coarse), flat);
}

// Of one tet, all of whose edges ask for the same.
int level_for(double num_wanted, int most = 10)
{
  CoarseMesh coarse;
  coarse.vertex_xyz = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
  coarse.tet_vertices = {0, 1, 2, 3};
  const auto levels =
      choose_levels(coarse, mesh::coarse_edges(coarse), std::vector<double>(6, num_wanted), most);
  EXPECT_TRUE(levels.is_uniform());
  return levels.largest();
}

TEST(ChooseLevels, GivesPartsOfAtMost140PercentOfWhatIsWanted)
{
  constexpr double kMost = std::numeric_limits<double>::max();
  EXPECT_EQ(level_for(0.0), 0);
  EXPECT_EQ(level_for(0.01), 0);
  EXPECT_EQ(level_for(1.0), 0);
  for (int level = 0; level < 10; ++level) {
    const double limit = std::ldexp(1.4, level);
    EXPECT_EQ(level_for(limit), level) << "the limit is enough";
    EXPECT_EQ(level_for(std::nextafter(limit, 0.0)), level);
    EXPECT_EQ(level_for(std::nextafter(limit, kMost)), level + 1);
    EXPECT_EQ(level_for(std::ldexp(1.0, level)), level);
    EXPECT_EQ(level_for(std::ldexp(1.3, level)), level);
    EXPECT_EQ(level_for(std::ldexp(1.5, level)), level + 1);
  }
}

TEST(ChooseLevels, StaysBelowTheMost)
{
  for (int most = 0; most <= 10; ++most) {
    EXPECT_EQ(level_for(1e6, most), most);
    EXPECT_EQ(level_for(std::numeric_limits<double>::infinity(), most), most);
    EXPECT_EQ(level_for(2.0, most), std::min(1, most));
  }
}

struct Wanted {
  std::vector<LocalIndex> edges{};
  std::vector<double> num_wanted{};
  std::vector<int> own_levels{};
};

Wanted some_wanted(const CoarseMesh& coarse, int most, double share, std::uint32_t seed)
{
  std::mt19937 random(seed);
  Wanted wanted{.edges = mesh::coarse_edges(coarse)};
  for (std::size_t e = 0; 2 * e < wanted.edges.size(); ++e) {
    const bool is_above = static_cast<double>(random() % 1000) < 1000.0 * share;
    const int level = is_above ? static_cast<int>(random() % 7) : 0;
    wanted.num_wanted.push_back(std::ldexp(1.2, level));
    wanted.own_levels.push_back(std::min(level, most));
  }
  return wanted;
}

// All keep the rule, and whatever is above its own level has something above it in some tet: since
// that goes up, it ends at an edge that wants so much, and nothing can be lower.
TEST(ChooseLevels, RaisesAsLittleAsTheRuleAllows)
{
  for (std::uint32_t seed = 1; seed < 25; ++seed) {
    CoarseMesh coarse = testing::shuffled(testing::kuhn_cube(3), seed);
    coarse.face_vertices.clear();  // Triangles on the geometry have a rule of their own.
    const int most = seed % 3 == 0 ? 4 : 10;
    const Wanted wanted = some_wanted(coarse, most, seed % 2 == 0 ? 0.02 : 0.3, seed);
    const EdgeLevels levels = choose_levels(coarse, wanted.edges, wanted.num_wanted, most);
    EXPECT_LE(levels.largest(), most);
    std::set<std::array<LocalIndex, 2>> is_beside_higher;
    for (LocalIndex t = 0; t < coarse.num_tets(); ++t) {
      const auto tet = coarse.tet(t);
      std::array<int, 6> of_edges{};
      for (std::size_t e = 0; e < 6; ++e) {
        const auto [a, b] = mesh::kTetEdgeCorners[e];
        of_edges[e] = levels.of(tet[a], tet[b]);
      }
      const auto [least, largest] = std::ranges::minmax(of_edges);
      ASSERT_LE(largest - least, 1);
      for (std::size_t e = 0; e < 6; ++e) {
        const auto [low, high] =
            std::minmax(tet[mesh::kTetEdgeCorners[e][0]], tet[mesh::kTetEdgeCorners[e][1]]);
        if (of_edges[e] < largest) is_beside_higher.insert({low, high});
      }
    }
    int num_raised = 0;
    for (std::size_t e = 0; e < wanted.own_levels.size(); ++e) {
      const std::array edge{wanted.edges[2 * e], wanted.edges[2 * e + 1]};
      const int level = levels.of(edge[0], edge[1]);
      EXPECT_GE(level, wanted.own_levels[e]);
      if (level == wanted.own_levels[e]) continue;
      EXPECT_TRUE(is_beside_higher.contains(edge));
      ++num_raised;
    }
    EXPECT_GT(num_raised, 0);
  }
}

TEST(ChooseLevels, LeavesNoTriangleOnTheGeometryWithTwoFinerSides)
{
  for (std::uint32_t seed = 1; seed < 25; ++seed) {
    CoarseMesh coarse = testing::shuffled(testing::kuhn_cube(3), seed);
    const Wanted wanted = some_wanted(coarse, 10, 0.1, seed);
    const EdgeLevels levels = choose_levels(coarse, wanted.edges, wanted.num_wanted, 10);
    for (LocalIndex f = 0; f < coarse.num_faces(); ++f) {
      const LocalIndex* v = &coarse.face_vertices[3 * at(f)];
      std::array sides{levels.of(v[0], v[1]), levels.of(v[0], v[2]), levels.of(v[1], v[2])};
      std::ranges::sort(sides);
      EXPECT_FALSE(sides[0] < sides[1]);
    }
    coarse.face_vertices.clear();
    const EdgeLevels without = choose_levels(coarse, wanted.edges, wanted.num_wanted, 10);
    for (std::size_t e = 0; e < wanted.edges.size(); e += 2) {
      EXPECT_GE(levels.of(wanted.edges[e], wanted.edges[e + 1]),
                without.of(wanted.edges[e], wanted.edges[e + 1]));
    }
  }
}

TEST(ChooseLevels, DoesNotDependOnTheOrderOfTheTets)
{
  const CoarseMesh coarse = testing::kuhn_cube(3);
  const Wanted wanted = some_wanted(coarse, 10, 0.1, 17);
  const EdgeLevels levels = choose_levels(coarse, wanted.edges, wanted.num_wanted, 10);
  std::vector<std::array<LocalIndex, 4>> tets;
  for (LocalIndex t = 0; t < coarse.num_tets(); ++t) {
    const auto v = coarse.tet(t);
    tets.push_back({v[0], v[1], v[2], v[3]});
  }
  std::mt19937 random(2);
  for (int turn = 0; turn < 20; ++turn) {
    std::ranges::shuffle(tets, random);
    CoarseMesh other = coarse;
    other.tet_vertices.clear();
    for (auto& tet : tets) {
      std::ranges::shuffle(tet, random);
      other.tet_vertices.insert(other.tet_vertices.end(), tet.begin(), tet.end());
    }
    EXPECT_EQ(mesh::coarse_edges(other), wanted.edges);
    EXPECT_EQ(choose_levels(other, wanted.edges, wanted.num_wanted, 10), levels);
  }
}

TEST(ChooseLevels, WithoutTetsIsNone) { EXPECT_EQ(choose_levels({}, {}, {}, 5), EdgeLevels(0)); }

}  // namespace
}  // namespace tessera::refine
