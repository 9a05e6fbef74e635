// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/migrate/distributed_mesh.hpp"

#include <algorithm>
#include <cstddef>

namespace tessera::migrate {

IndexLists values_around_vertices(const MeshBlock& block, std::span<const LocalIndex> tet_values)
{
  struct Node {
    LocalIndex value;
    LocalIndex next;  // Of the same vertex.
  };
  std::vector<Node> nodes;
  nodes.reserve(block.vertex_ids.size());
  std::vector<LocalIndex> first(block.vertex_ids.size(), kNoIndex);
  for (LocalIndex t = 0; t < block.num_tets(); ++t) {
    for (const LocalIndex v : block.tet(t)) {
      LocalIndex node = first[at(v)];
      while (node != kNoIndex && nodes[at(node)].value != tet_values[at(t)]) {
        node = nodes[at(node)].next;
      }
      if (node != kNoIndex) continue;
      nodes.push_back({tet_values[at(t)], first[at(v)]});
      first[at(v)] = static_cast<LocalIndex>(nodes.size()) - 1;
    }
  }

  IndexLists lists;
  lists.offsets.reserve(first.size() + 1);
  lists.values.reserve(nodes.size());
  for (LocalIndex node : first) {
    const std::size_t begin = lists.values.size();
    for (; node != kNoIndex; node = nodes[at(node)].next) {
      lists.values.push_back(nodes[at(node)].value);
    }
    std::sort(lists.values.begin() + static_cast<std::ptrdiff_t>(begin), lists.values.end());
    lists.end_list();
  }
  return lists;
}

Hash128 digest_of_tets(const MeshBlock& block)
{
  constexpr std::array<GlobalIndex, 4> kNoIds{};
  Hash128 digest;
  for (LocalIndex t = 0; t < block.num_tets(); ++t) {
    std::array<double, 12> xyz;
    auto to = xyz.begin();
    for (const LocalIndex v : block.tet(t)) to = std::ranges::copy(block.position(v), to).out;
    digest += hash_tet(kNoIds, xyz, block.tet_material[at(t)]);
  }
  return digest;
}

}  // namespace tessera::migrate
