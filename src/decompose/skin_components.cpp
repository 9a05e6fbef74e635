// SPDX-License-Identifier: BSD-3-Clause
#include "decompose/skin_components.hpp"

#include <numeric>

namespace tessera::decompose {

SkinComponents::SkinComponents(const TetGraph& graph)
    : graph_(&graph),
      parent_(static_cast<std::size_t>(graph.num_vertices())),
      num_triangles_(static_cast<std::size_t>(graph.num_vertices()), 0)
{
  std::iota(parent_.begin(), parent_.end(), 0);
}

LocalIndex SkinComponents::root_of(LocalIndex vertex)
{
  auto at = static_cast<std::size_t>(vertex);
  while (parent_[at] != static_cast<LocalIndex>(at)) {
    parent_[at] = parent_[static_cast<std::size_t>(parent_[at])];
    at = static_cast<std::size_t>(parent_[at]);
  }
  return static_cast<LocalIndex>(at);
}

void SkinComponents::collect(const TetPartition& partition, std::span<const LocalIndex> tets)
{
  for (const LocalIndex t : tets) {
    const auto vertices = graph_->vertices(t);
    const auto neighbours = graph_->neighbours(t);
    for (std::size_t face = 0; face < 4; ++face) {
      const bool is_inner =
          neighbours[face] != kNoIndex && partition.of(neighbours[face]) == partition.of(t);
      if (is_inner) continue;
      const LocalIndex first = vertices[face == 0 ? 1 : 0];
      skin_.push_back({t, first});
      for (std::size_t corner = 0; corner < 4; ++corner) {
        if (corner == face) continue;
        touched_.push_back(vertices[corner]);
        const LocalIndex a = root_of(first);
        parent_[static_cast<std::size_t>(root_of(vertices[corner]))] = a;
      }
    }
  }
}

std::vector<LocalIndex> SkinComponents::tets_at_cavity(const TetPartition& partition,
                                                       std::span<const LocalIndex> tets)
{
  skin_.clear();
  touched_.clear();
  collect(partition, tets);
  const auto size_of = [&](LocalIndex root) -> LocalIndex& {
    return num_triangles_[static_cast<std::size_t>(root)];
  };
  for (const SkinTriangle& triangle : skin_) ++size_of(root_of(triangle.vertex));
  LocalIndex outer = root_of(skin_.front().vertex);
  for (const SkinTriangle& triangle : skin_) {
    const LocalIndex root = root_of(triangle.vertex);
    if (size_of(root) > size_of(outer)) outer = root;
  }
  std::vector<LocalIndex> at_cavity;
  LocalIndex cavity = kNoIndex;
  for (const SkinTriangle& triangle : skin_) {
    const LocalIndex root = root_of(triangle.vertex);
    if (root == outer) continue;
    if (cavity == kNoIndex) cavity = root;
    const bool is_new = at_cavity.empty() || at_cavity.back() != triangle.tet;
    if (root == cavity && is_new) at_cavity.push_back(triangle.tet);
  }
  for (const LocalIndex v : touched_) {
    parent_[static_cast<std::size_t>(v)] = v;
    num_triangles_[static_cast<std::size_t>(v)] = 0;
  }
  return at_cavity;
}

}  // namespace tessera::decompose
