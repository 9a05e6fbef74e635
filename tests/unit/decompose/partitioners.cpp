// SPDX-License-Identifier: BSD-3-Clause
#include "partitioners.hpp"

#include <cstdint>

namespace tessera::testing {

std::vector<LocalIndex> FakePartitioner::partition(const decompose::Graph& graph,
                                                   LocalIndex num_parts) const
{
  std::vector<LocalIndex> part;
  for (LocalIndex v = 0; v < graph.num_vertices(); ++v) part.push_back(part_of_(v, num_parts));
  return part;
}

FakePartitioner random_partitioner(unsigned seed)
{
  return FakePartitioner([seed](LocalIndex vertex, LocalIndex num_parts) {
    auto bits = (static_cast<std::uint64_t>(seed) << 32U) + static_cast<std::uint64_t>(vertex);
    for (int round = 0; round < 3; ++round) {
      bits = (bits ^ (bits >> 29U)) * 0x9E3779B97F4A7C15ULL + 0x632BE59BD9B4E019ULL;
    }
    return static_cast<LocalIndex>((bits >> 33U) % static_cast<std::uint64_t>(num_parts));
  });
}

}  // namespace tessera::testing
