// SPDX-License-Identifier: BSD-3-Clause
#include "decompose/repair/skin_components.hpp"

namespace tessera::decompose {

SkinComponents::SkinComponents(const TetGraph& graph)
    : graph_(&graph),
      surfaces_(graph.num_vertices()),
      num_triangles_(static_cast<std::size_t>(graph.num_vertices()), 0)
{
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
        surfaces_.join(first, vertices[corner]);
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
  for (const SkinTriangle& triangle : skin_) ++size_of(surfaces_.find(triangle.vertex));
  LocalIndex outer = surfaces_.find(skin_.front().vertex);
  for (const SkinTriangle& triangle : skin_) {
    const LocalIndex root = surfaces_.find(triangle.vertex);
    if (size_of(root) > size_of(outer)) outer = root;
  }
  std::vector<LocalIndex> at_cavity;
  LocalIndex cavity = kNoIndex;
  for (const SkinTriangle& triangle : skin_) {
    const LocalIndex root = surfaces_.find(triangle.vertex);
    if (root == outer) continue;
    if (cavity == kNoIndex) cavity = root;
    const bool is_new = at_cavity.empty() || at_cavity.back() != triangle.tet;
    if (root == cavity && is_new) at_cavity.push_back(triangle.tet);
  }
  surfaces_.separate(touched_);
  for (const LocalIndex v : touched_) num_triangles_[static_cast<std::size_t>(v)] = 0;
  return at_cavity;
}

}  // namespace tessera::decompose
