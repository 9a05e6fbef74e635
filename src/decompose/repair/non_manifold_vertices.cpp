// SPDX-License-Identifier: BSD-3-Clause
#include "decompose/repair/non_manifold_vertices.hpp"

#include <algorithm>
#include <cstddef>

namespace tessera::decompose {

NonManifoldVertices::NonManifoldVertices(const TetGraph& graph, const TetPartition& partition)
    : graph_(&graph),
      partition_(&partition),
      total_(static_cast<std::size_t>(graph.num_vertices()), 0),
      node_(static_cast<std::size_t>(graph.num_vertices()), kNoIndex)
{
  for (LocalIndex v = 0; v < graph.num_vertices(); ++v) compute_total(v);
}

void NonManifoldVertices::collect_link(LocalIndex v, LocalIndex part)
{
  link_.clear();
  for (const LocalIndex t : graph_->tets_at(v)) {
    if (partition_->of(t) != part) continue;
    const auto vertices = graph_->vertices(t);
    const auto neighbours = graph_->neighbours(t);
    for (std::size_t face = 0; face < 4; ++face) {
      if (vertices[face] == v) continue;
      if (neighbours[face] != kNoIndex && partition_->of(neighbours[face]) == part) continue;
      std::array<LocalIndex, 2> ends{};
      std::size_t found = 0;
      for (std::size_t corner = 0; corner < 4; ++corner) {
        if (corner != face && vertices[corner] != v) ends[found++] = vertices[corner];
      }
      link_.push_back({ends[0], ends[1]});
    }
  }
}

LocalIndex NonManifoldVertices::node_of(LocalIndex vertex)
{
  LocalIndex& node = node_[static_cast<std::size_t>(vertex)];
  if (node == kNoIndex) {
    node = components_.add();
    vertices_.push_back(vertex);
  }
  return node;
}

int NonManifoldVertices::count(LocalIndex v, LocalIndex part)
{
  collect_link(v, part);
  if (link_.empty()) return 0;
  vertices_.clear();
  components_.clear();
  int num_joins = 0;
  for (const LinkEdge& edge : link_) {
    const LocalIndex a = node_of(edge.a);
    if (components_.join(a, node_of(edge.b))) ++num_joins;
  }
  const int num_nodes = static_cast<int>(vertices_.size());
  const int num_components = num_nodes - num_joins;
  for (const LocalIndex vertex : vertices_) node_[static_cast<std::size_t>(vertex)] = kNoIndex;
  return static_cast<int>(link_.size()) - num_nodes + num_components - 1;
}

int NonManifoldVertices::count_at_tet(LocalIndex t, LocalIndex part, LocalIndex other_part)
{
  int sum = 0;
  for (const LocalIndex v : graph_->vertices(t)) sum += count(v, part) + count(v, other_part);
  return sum;
}

std::span<const LocalIndex> NonManifoldVertices::parts_at(LocalIndex v)
{
  parts_.clear();
  for (const LocalIndex t : graph_->tets_at(v)) parts_.push_back(partition_->of(t));
  std::sort(parts_.begin(), parts_.end());
  parts_.erase(std::unique(parts_.begin(), parts_.end()), parts_.end());
  return parts_;
}

void NonManifoldVertices::compute_total(LocalIndex v)
{
  int sum = 0;
  for (const LocalIndex part : parts_at(v)) sum += count(v, part);
  total_[static_cast<std::size_t>(v)] = sum;
}

void NonManifoldVertices::refresh(std::span<const LocalIndex> tets)
{
  stale_.clear();
  for (const LocalIndex t : tets) {
    const auto vertices = graph_->vertices(t);
    stale_.insert(stale_.end(), vertices.begin(), vertices.end());
  }
  std::sort(stale_.begin(), stale_.end());
  stale_.erase(std::unique(stale_.begin(), stale_.end()), stale_.end());
  for (const LocalIndex v : stale_) compute_total(v);
}

LocalIndex NonManifoldVertices::pinched_edge(LocalIndex v, LocalIndex part)
{
  collect_link(v, part);
  std::vector<LocalIndex> ends;
  for (const LinkEdge& edge : link_) ends.insert(ends.end(), {edge.a, edge.b});
  std::sort(ends.begin(), ends.end());
  for (std::size_t i = 2; i < ends.size(); ++i) {
    if (ends[i] == ends[i - 2]) return ends[i];  // two triangles are the rule
  }
  return kNoIndex;
}

}  // namespace tessera::decompose
