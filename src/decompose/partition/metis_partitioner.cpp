// SPDX-License-Identifier: BSD-3-Clause
#include <array>
#include <cstddef>
#include <string>

#include <fmt/format.h>
#include <metis.h>

#include "tessera/base/error.hpp"
#include "tessera/base/held_signals.hpp"
#include "tessera/decompose/graph_partitioner.hpp"

namespace tessera::decompose {
namespace {

std::vector<idx_t> as_metis(const std::vector<LocalIndex>& values)
{
  return {values.begin(), values.end()};
}

// Recursive bisection for any number of parts, measured against k-way with METIS_OPTION_CONTIG on
// nine trials with coarse meshes of NETGEN (16 to 66 parts). K-way cut 4 % more area (-1 % to 11 %)
// and was not faster. Its lightest part had 0.51 of the mean weight in the median instead of 0.85,
// and 23 subdomains had to be split instead of one. Parts that come out disconnected are the
// caller's to mend.
class MetisPartitioner final : public GraphPartitioner {
 public:
  [[nodiscard]] std::vector<LocalIndex> partition(const Graph& graph,
                                                  LocalIndex num_parts) const override
  {
    std::array<idx_t, METIS_NOPTIONS> options{};
    METIS_SetDefaultOptions(options.data());
    options[METIS_OPTION_SEED] = 1;
    options[METIS_OPTION_NUMBERING] = 0;

    auto offsets = as_metis(graph.offsets);
    auto neighbours = as_metis(graph.neighbours);
    auto vertex_weight = as_metis(graph.vertex_weight);
    auto edge_weight = as_metis(graph.edge_weight);
    idx_t num_vertices = graph.num_vertices();
    idx_t num_constraints = 1;
    idx_t parts = num_parts;
    idx_t cut = 0;
    std::vector<idx_t> part(static_cast<std::size_t>(num_vertices));
    // METIS takes a SIGTERM that comes while it works for an error of its own and jumps out of what
    // it does, even out of malloc(): the next malloc() then waits for ever. Handlers that it puts
    // back are lost after one signal.
    const HeldSignals held{SIGTERM, SIGABRT};
    const int status = METIS_PartGraphRecursive(
        &num_vertices, &num_constraints, offsets.data(), neighbours.data(), vertex_weight.data(),
        nullptr, edge_weight.data(), &parts, nullptr, nullptr, options.data(), &cut, part.data());
    if (status != METIS_OK) {
      throw MeshError(
          fmt::format("METIS failed with code {} on a graph of {} vertices and {} parts", status,
                      num_vertices, num_parts));
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
  return fmt::format("{}.{}.{}", METIS_VER_MAJOR, METIS_VER_MINOR, METIS_VER_SUBMINOR);
}

}  // namespace tessera::decompose
