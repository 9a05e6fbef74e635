// SPDX-License-Identifier: BSD-3-Clause
#include "decompose/parts.hpp"

#include <algorithm>
#include <numeric>
#include <set>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace tessera::decompose {
namespace {

// A row of vertices, each joined to the next.
Graph path(std::vector<std::int32_t> weights)
{
  Graph graph;
  const auto size = static_cast<LocalIndex>(weights.size());
  for (LocalIndex v = 0; v < size; ++v) {
    for (const LocalIndex w : {v - 1, v + 1}) {
      if (w < 0 || w == size) continue;
      graph.neighbours.push_back(w);
      graph.edge_weight.push_back(1);
    }
    graph.offsets.push_back(static_cast<LocalIndex>(graph.neighbours.size()));
  }
  graph.vertex_weight = std::move(weights);
  return graph;
}

// n by n vertices, each joined to its up to four neighbours.
Graph square(LocalIndex n)
{
  Graph graph;
  for (LocalIndex v = 0; v < n * n; ++v) {
    const LocalIndex x = v % n;
    const LocalIndex y = v / n;
    for (const auto& [i, j] : {std::pair{x - 1, y}, {x + 1, y}, {x, y - 1}, {x, y + 1}}) {
      if (i < 0 || j < 0 || i == n || j == n) continue;
      graph.neighbours.push_back(i + n * j);
      graph.edge_weight.push_back(1);
    }
    graph.offsets.push_back(static_cast<LocalIndex>(graph.neighbours.size()));
    graph.vertex_weight.push_back(1);
  }
  return graph;
}

class Given final : public GraphPartitioner {
 public:
  explicit Given(std::vector<LocalIndex> part) : part_(std::move(part)) {}
  [[nodiscard]] std::vector<LocalIndex> partition(const Graph& /*graph*/,
                                                  LocalIndex /*num_parts*/) const override
  {
    return part_;
  }

 private:
  std::vector<LocalIndex> part_;
};

LocalIndex num_components(const Graph& graph, const std::vector<LocalIndex>& part)
{
  std::vector<LocalIndex> root(part.size());
  std::iota(root.begin(), root.end(), 0);
  for (std::size_t round = 0; round < part.size(); ++round) {
    for (LocalIndex v = 0; v < graph.num_vertices(); ++v) {
      for (LocalIndex e = graph.offsets[at(v)]; e < graph.offsets[at(v) + 1]; ++e) {
        const LocalIndex w = graph.neighbours[at(e)];
        if (part[at(v)] == part[at(w)]) root[at(v)] = std::min(root[at(v)], root[at(w)]);
      }
    }
  }
  return static_cast<LocalIndex>(std::set<LocalIndex>(root.begin(), root.end()).size());
}

std::vector<std::int64_t> weights_of(const Graph& graph, const std::vector<LocalIndex>& part)
{
  std::vector<std::int64_t> weights(at(*std::ranges::max_element(part)) + 1, 0);
  for (std::size_t v = 0; v < part.size(); ++v) weights[at(part[v])] += graph.vertex_weight[v];
  return weights;
}

TEST(BalancedParts, GoodPartsStay)
{
  const std::vector<LocalIndex> good{1, 1, 0, 0};
  EXPECT_EQ(balanced_parts(path({1, 1, 1, 1}), 2, Given(good)), good);
}

TEST(BalancedParts, LooseComponentGoesToItsNeighbour)
{
  const Graph graph = path({3, 3, 1, 3, 3});
  EXPECT_EQ(balanced_parts(graph, 2, Given({0, 0, 1, 0, 1})),
            (std::vector<LocalIndex>{0, 0, 0, 1, 1}));
}

TEST(BalancedParts, HeavyPartGivesAway)
{
  const Graph graph = path({1, 1, 1, 1, 1, 1, 1, 1});
  const auto part = balanced_parts(graph, 2, Given({0, 0, 0, 0, 0, 0, 0, 1}));
  EXPECT_EQ(part, (std::vector<LocalIndex>{0, 0, 0, 0, 1, 1, 1, 1}));
}

// To give the heavy vertex 1 away would balance best, but it holds its part together.
TEST(BalancedParts, NoPartIsTornApart)
{
  Graph star;
  star.offsets = {0, 1, 4, 5, 6};
  star.neighbours = {1, 0, 2, 3, 1, 1};
  star.edge_weight = {1, 1, 1, 1, 1, 1};
  star.vertex_weight = {1, 4, 1, 1};
  const std::vector<LocalIndex> part{0, 0, 0, 1};
  EXPECT_EQ(balanced_parts(star, 2, Given(part)), part);
}

TEST(BalancedParts, MetisOnASquareIsBalancedAndConnected)
{
  const Graph graph = square(24);
  for (const LocalIndex num_parts : {2, 3, 7, 16}) {
    const auto part = balanced_parts(graph, num_parts, *make_metis_partitioner());
    EXPECT_EQ(num_components(graph, part), num_parts);
    const auto weights = weights_of(graph, part);
    EXPECT_LE(static_cast<double>(*std::ranges::max_element(weights)),
              1.03 * 576.0 / num_parts + 1.0);
  }
}

TEST(BalancedParts, UnconnectedGraphKeepsItsComponents)
{
  Graph graph = path({1, 1, 1, 1});
  graph.offsets = {0, 1, 2, 3, 4};  // Two pairs.
  graph.neighbours = {1, 0, 3, 2};
  graph.edge_weight = {1, 1, 1, 1};
  const auto part = balanced_parts(graph, 2, Given({0, 1, 1, 0}));
  EXPECT_EQ(num_components(graph, part), 2);
}

}  // namespace
}  // namespace tessera::decompose
