// SPDX-License-Identifier: BSD-3-Clause
#include <array>
#include <cstddef>
#include <string>

#include <metis.h>

#include "tessera/base/error.hpp"
#include "tessera/decompose/graph_partitioner.hpp"

namespace tessera::decompose {
namespace {

// METIS refuses METIS_OPTION_CONTIG for a graph that is not connected.
bool is_connected(const Graph& graph)
{
  const auto size = static_cast<std::size_t>(graph.num_vertices());
  std::vector<bool> reached(size, false);
  std::vector<LocalIndex> stack{0};
  reached[0] = true;
  std::size_t num_reached = 0;
  while (!stack.empty()) {
    const auto v = static_cast<std::size_t>(stack.back());
    stack.pop_back();
    ++num_reached;
    for (LocalIndex i = graph.offsets[v]; i < graph.offsets[v + 1]; ++i) {
      const LocalIndex w = graph.neighbours[static_cast<std::size_t>(i)];
      if (reached[static_cast<std::size_t>(w)]) continue;
      reached[static_cast<std::size_t>(w)] = true;
      stack.push_back(w);
    }
  }
  return num_reached == size;
}

std::vector<idx_t> as_metis(const std::vector<LocalIndex>& values)
{
  return {values.begin(), values.end()};
}

class MetisPartitioner final : public GraphPartitioner {
 public:
  [[nodiscard]] std::vector<LocalIndex> partition(const Graph& graph,
                                                  LocalIndex num_parts) const override
  {
    // Recursive bisection cuts less for few parts, k-way for many; the number is that of METIS's
    // own program. Only k-way knows connected parts.
    constexpr LocalIndex max_recursive_parts = 8;
    const bool use_kway = num_parts > max_recursive_parts;

    std::array<idx_t, METIS_NOPTIONS> options{};
    METIS_SetDefaultOptions(options.data());
    options[METIS_OPTION_SEED] = 1;
    options[METIS_OPTION_NUMBERING] = 0;
    if (use_kway && is_connected(graph)) options[METIS_OPTION_CONTIG] = 1;

    auto offsets = as_metis(graph.offsets);
    auto neighbours = as_metis(graph.neighbours);
    auto vertex_weight = as_metis(graph.vertex_weight);
    auto edge_weight = as_metis(graph.edge_weight);
    idx_t num_vertices = graph.num_vertices();
    idx_t num_constraints = 1;
    idx_t parts = num_parts;
    idx_t cut = 0;
    std::vector<idx_t> part(static_cast<std::size_t>(num_vertices));
    auto* const metis = use_kway ? METIS_PartGraphKway : METIS_PartGraphRecursive;
    const int status = metis(&num_vertices, &num_constraints, offsets.data(), neighbours.data(),
                             vertex_weight.data(), nullptr, edge_weight.data(), &parts, nullptr,
                             nullptr, options.data(), &cut, part.data());
    if (status != METIS_OK) {
      throw MeshError("METIS failed with code " + std::to_string(status) + " on a graph of "
                      + std::to_string(num_vertices) + " vertices and " + std::to_string(num_parts)
                      + " parts");
    }
    return {part.begin(), part.end()};
  }
};

}  // namespace

std::unique_ptr<GraphPartitioner> make_metis_partitioner()
{
  return std::make_unique<MetisPartitioner>();
}

std::string metis_version()
{
  return std::to_string(METIS_VER_MAJOR) + "." + std::to_string(METIS_VER_MINOR) + "."
         + std::to_string(METIS_VER_SUBMINOR);
}

}  // namespace tessera::decompose
