// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/decompose/graph_partitioner.hpp"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <memory>
#include <thread>
#include <vector>

#include <gtest/gtest.h>
#include <pthread.h>

namespace tessera::decompose {
namespace {

// A path of `length` vertices; vertex i weighs `weight(i)`.
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

INSTANTIATE_TEST_SUITE_P(Both, AnyPartitioner,
                         ::testing::Values(&make_metis_partitioner, &make_block_partitioner));

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
