// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/decompose/graph_partitioner.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <map>
#include <memory>
#include <numeric>
#include <set>
#include <thread>
#include <vector>

#include <gtest/gtest.h>
#include <pthread.h>

namespace tessera::decompose {
namespace {

// A path of `length` vertices along a diagonal; vertex i weighs `weight(i)`.
template <class Weight>
Graph path(LocalIndex length, const Weight& weight)
{
  Graph graph;
  for (LocalIndex v = 0; v < length; ++v) {
    for (const LocalIndex neighbour : {v - 1, v + 1}) {
      if (neighbour < 0 || neighbour >= length) continue;
      graph.neighbours.push_back(neighbour);
      graph.edge_weight.push_back(1);
    }
    graph.offsets.push_back(static_cast<LocalIndex>(graph.neighbours.size()));
    graph.vertex_weight.push_back(weight(v));
    graph.place.push_back({1.0 * v, 1.0 * v, 1.0 * v});
  }
  return graph;
}

std::vector<int> weights_of_parts(const Graph& graph, const std::vector<LocalIndex>& part,
                                  LocalIndex num_parts)
{
  std::vector<int> sums(static_cast<std::size_t>(num_parts), 0);
  for (std::size_t v = 0; v < part.size(); ++v) {
    sums.at(static_cast<std::size_t>(part[v])) += graph.vertex_weight[v];
  }
  return sums;
}

int num_cuts(const std::vector<LocalIndex>& part)
{
  int cuts = 0;
  for (std::size_t v = 1; v < part.size(); ++v) cuts += part[v] != part[v - 1] ? 1 : 0;
  return cuts;
}

using Factory = std::unique_ptr<GraphPartitioner> (*)();
class AnyPartitioner : public ::testing::TestWithParam<Factory> {};

TEST_P(AnyPartitioner, BalancesTheWeightOfAPath)
{
  const Graph graph = path(240, [](LocalIndex v) { return v < 120 ? 30 : 10; });
  for (const LocalIndex k : {2, 4, 12}) {
    const auto part = GetParam()()->partition(graph, k);
    ASSERT_EQ(part.size(), 240U);
    EXPECT_EQ(num_cuts(part), k - 1);
    for (const int weight : weights_of_parts(graph, part, k)) EXPECT_NEAR(weight * k, 4800, 960);
  }
}

TEST_P(AnyPartitioner, IsAPureFunction)
{
  const Graph graph = path(100, [](LocalIndex v) { return 1 + v % 7; });
  const auto once = GetParam()()->partition(graph, 9);
  (void)GetParam()()->partition(path(50, [](LocalIndex) { return 1; }), 3);
  EXPECT_EQ(GetParam()()->partition(graph, 9), once);
}

TEST_P(AnyPartitioner, AcceptsAGraphInTwoPieces)
{
  Graph graph = path(40, [](LocalIndex) { return 1; });
  const Graph second = graph;
  for (std::size_t v = 0; v < 40; ++v) {
    graph.offsets.push_back(graph.offsets[40] + second.offsets[v + 1]);
    graph.vertex_weight.push_back(1);
    graph.place.push_back(second.place[v] + Vec3{0.0, 50.0, 0.0});
  }
  for (const LocalIndex neighbour : second.neighbours) {
    graph.neighbours.push_back(neighbour + 40);
    graph.edge_weight.push_back(1);
  }
  for (const LocalIndex k : {2, 10}) {
    const auto part = GetParam()()->partition(graph, k);
    ASSERT_EQ(part.size(), 80U);
    EXPECT_LT(*std::max_element(part.begin(), part.end()), k);
  }
}

INSTANTIATE_TEST_SUITE_P(All, AnyPartitioner,
                         ::testing::Values(&make_metis_partitioner, &make_block_partitioner,
                                           &make_octree_partitioner));

// Points in the middles of the cells of a cube, x running first. The octree needs no edges.
Graph cells_of_cube(LocalIndex num_a_side)
{
  Graph graph;
  for (LocalIndex z = 0; z < num_a_side; ++z) {
    for (LocalIndex y = 0; y < num_a_side; ++y) {
      for (LocalIndex x = 0; x < num_a_side; ++x) {
        graph.place.push_back({x + 0.5, y + 0.5, z + 0.5});
        graph.vertex_weight.push_back(3);
        graph.offsets.push_back(0);
      }
    }
  }
  return graph;
}

// Eight parts of a cube are its eighths, and so on.
TEST(OctreePartitioner, CutsACubeIntoOctants)
{
  constexpr LocalIndex kSide = 16;
  const Graph graph = cells_of_cube(kSide);
  for (const LocalIndex octants_a_side : {2, 4, 8}) {
    const LocalIndex num_parts = octants_a_side * octants_a_side * octants_a_side;
    const auto part = make_octree_partitioner()->partition(graph, num_parts);
    std::map<std::array<int, 3>, std::set<LocalIndex>> parts_of_octants;
    for (std::size_t v = 0; v < part.size(); ++v) {
      std::array<int, 3> octant{};
      for (std::size_t axis = 0; axis < 3; ++axis) {
        octant[axis] = static_cast<int>(graph.place[v][axis]) * octants_a_side / kSide;
      }
      parts_of_octants[octant].insert(part[v]);
    }
    ASSERT_EQ(parts_of_octants.size(), at(num_parts));
    std::set<LocalIndex> seen;
    for (const auto& [octant, parts] : parts_of_octants) {
      EXPECT_EQ(parts.size(), 1U);
      seen.insert(parts.begin(), parts.end());
    }
    EXPECT_EQ(seen.size(), at(num_parts));
  }
}

// One after the other along the curve, parts are beside each other: they share a side.
TEST(OctreePartitioner, ConsecutivePartsAreNeighbours)
{
  const Graph graph = cells_of_cube(8);
  const auto part = make_octree_partitioner()->partition(graph, 512);
  std::vector<Vec3> place_of_part(512);
  for (std::size_t v = 0; v < part.size(); ++v) place_of_part.at(at(part[v])) = graph.place[v];
  for (std::size_t p = 1; p < place_of_part.size(); ++p) {
    EXPECT_EQ(norm(place_of_part[p] - place_of_part[p - 1]), 1.0) << p;
  }
}

// Weight decides, not space: one corner weighs as much as all the rest.
TEST(OctreePartitioner, BalancesWhatIsUneven)
{
  Graph graph = cells_of_cube(16);
  for (std::size_t v = 0; v < graph.place.size(); ++v) {
    if (std::ranges::max(graph.place[v]) < 4.0) graph.vertex_weight[v] = 189;
  }
  const auto part = make_octree_partitioner()->partition(graph, 6);
  const auto weights = weights_of_parts(graph, part, 6);
  const int total = std::accumulate(weights.begin(), weights.end(), 0);
  for (const int weight : weights) EXPECT_NEAR(6.0 * weight / total, 1.0, 0.04);
}

TEST(OctreePartitioner, PointsAtOnePlaceAreOneOctant)
{
  Graph graph = cells_of_cube(3);
  for (Vec3& place : graph.place) place = {1.0, 2.0, 3.0};
  const auto part = make_octree_partitioner()->partition(graph, 4);
  EXPECT_EQ(std::set<LocalIndex>(part.begin(), part.end()).size(), 1U);
}

volatile std::sig_atomic_t num_signals = 0;

TEST(MetisPartitioner, ASignalWhileItWorksChangesNothingAndIsNotLost)
{
  const Graph graph = path(200'000, [](LocalIndex) { return 1; });
  const auto metis = make_metis_partitioner();
  const auto undisturbed = metis->partition(graph, 64);
  const auto before = std::signal(SIGTERM, [](int) { num_signals = num_signals + 1; });
  for (int delay_ms = 1; delay_ms <= 20; ++delay_ms) {
    num_signals = 0;
    std::thread sender([main_thread = pthread_self(), delay_ms] {
      std::this_thread::sleep_for(std::chrono::milliseconds(delay_ms));
      pthread_kill(main_thread, SIGTERM);
    });
    const auto disturbed = metis->partition(graph, 64);
    sender.join();
    EXPECT_EQ(disturbed, undisturbed);
    EXPECT_EQ(num_signals, 1);
  }
  std::signal(SIGTERM, before);
}

TEST(BlockPartitioner, LeavesNoPartEmpty)
{
  const Graph graph = path(10, [](LocalIndex v) { return v == 0 ? 1000 : 1; });
  for (LocalIndex k = 2; k <= 10; ++k) {
    const auto part = make_block_partitioner()->partition(graph, k);
    for (const int weight : weights_of_parts(graph, part, k)) EXPECT_GT(weight, 0);
  }
}

}  // namespace
}  // namespace tessera::decompose
