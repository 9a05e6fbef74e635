// SPDX-License-Identifier: BSD-3-Clause
#include "decompose/partition/checked_partition.hpp"

#include <cstddef>
#include <numeric>
#include <string>

#include <fmt/format.h>

#include "tessera/base/error.hpp"

namespace tessera::decompose {

std::vector<LocalIndex> checked_partition(const GraphPartitioner& partitioner, const Graph& graph,
                                          LocalIndex num_parts)
{
  const auto size = static_cast<std::size_t>(graph.num_vertices());
  std::vector<LocalIndex> part(size, 0);
  if (num_parts == 1) return part;
  if (num_parts == graph.num_vertices()) {
    std::iota(part.begin(), part.end(), 0);
    return part;
  }
  part = partitioner.partition(graph, num_parts);
  if (part.size() != size) {
    throw MeshError(
        fmt::format("graph partitioner: parts for {} of {} vertices", part.size(), size));
  }
  for (const LocalIndex p : part) {
    if (p < 0 || p >= num_parts) {
      throw MeshError(fmt::format("graph partitioner: part {} of {}", p, num_parts));
    }
  }
  return part;
}

}  // namespace tessera::decompose
