// SPDX-License-Identifier: BSD-3-Clause
#include <cstddef>
#include <cstdint>
#include <numeric>

#include "tessera/decompose/graph_partitioner.hpp"

namespace tessera::decompose {
namespace {

// Breadth-first from vertex 0, then from the lowest vertex not yet reached.
std::vector<LocalIndex> breadth_first_order(const Graph& graph)
{
  const auto size = static_cast<std::size_t>(graph.num_vertices());
  std::vector<LocalIndex> order;
  order.reserve(size);
  std::vector<bool> reached(size, false);
  const auto reach = [&](LocalIndex v) {
    if (reached[static_cast<std::size_t>(v)]) return;
    reached[static_cast<std::size_t>(v)] = true;
    order.push_back(v);
  };
  std::size_t head = 0;
  for (LocalIndex start = 0; start < graph.num_vertices(); ++start) {
    reach(start);
    for (; head < order.size(); ++head) {
      const auto v = static_cast<std::size_t>(order[head]);
      for (LocalIndex i = graph.offsets[v]; i < graph.offsets[v + 1]; ++i) {
        reach(graph.neighbours[static_cast<std::size_t>(i)]);
      }
    }
  }
  return order;
}

class BlockPartitioner final : public GraphPartitioner {
 public:
  [[nodiscard]] std::vector<LocalIndex> partition(const Graph& graph,
                                                  LocalIndex num_parts) const override
  {
    const auto total =
        std::accumulate(graph.vertex_weight.begin(), graph.vertex_weight.end(), std::int64_t{0});
    std::vector<LocalIndex> part(static_cast<std::size_t>(graph.num_vertices()));
    std::int64_t before = 0;
    LocalIndex current = 0;
    LocalIndex vertices_left = graph.num_vertices();
    bool current_is_empty = true;
    for (const LocalIndex v : breadth_first_order(graph)) {
      const bool is_full = before * num_parts >= total * (current + 1);
      const bool others_would_be_empty = vertices_left < num_parts - current;
      if (!current_is_empty && current + 1 < num_parts && (is_full || others_would_be_empty)) {
        ++current;
      }
      part[static_cast<std::size_t>(v)] = current;
      current_is_empty = false;
      before += graph.vertex_weight[static_cast<std::size_t>(v)];
      --vertices_left;
    }
    return part;
  }
};

}  // namespace

std::unique_ptr<GraphPartitioner> make_block_partitioner()
{
  return std::make_unique<BlockPartitioner>();
}

}  // namespace tessera::decompose
