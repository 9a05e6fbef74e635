// SPDX-License-Identifier: BSD-3-Clause
#include "decompose/spots.hpp"

#include <algorithm>
#include <cstddef>

namespace tessera::decompose {

Spots::Spots(const TetGraph& graph, const Labelling& labelling)
    : graph_(&graph),
      labelling_(&labelling),
      total_(static_cast<std::size_t>(graph.num_vertices()), 0),
      node_(static_cast<std::size_t>(graph.num_vertices()), kNoIndex)
{
  for (LocalIndex v = 0; v < graph.num_vertices(); ++v) compute_total(v);
}

void Spots::collect_link(LocalIndex v, LocalIndex label)
{
  link_.clear();
  for (const LocalIndex t : graph_->tets_at(v)) {
    if (labelling_->of(t) != label) continue;
    const auto vertices = graph_->vertices(t);
    const auto neighbours = graph_->neighbours(t);
    for (std::size_t face = 0; face < 4; ++face) {
      if (vertices[face] == v) continue;
      if (neighbours[face] != kNoIndex && labelling_->of(neighbours[face]) == label) continue;
      std::array<LocalIndex, 2> ends{};
      std::size_t found = 0;
      for (std::size_t corner = 0; corner < 4; ++corner) {
        if (corner != face && vertices[corner] != v) ends[found++] = vertices[corner];
      }
      link_.push_back({ends[0], ends[1]});
    }
  }
}

LocalIndex Spots::node_of(LocalIndex vertex)
{
  LocalIndex& node = node_[static_cast<std::size_t>(vertex)];
  if (node == kNoIndex) {
    node = static_cast<LocalIndex>(vertices_.size());
    vertices_.push_back(vertex);
    parent_.push_back(node);
  }
  return node;
}

LocalIndex Spots::root_of(LocalIndex node)
{
  auto at = static_cast<std::size_t>(node);
  while (parent_[at] != static_cast<LocalIndex>(at)) {
    parent_[at] = parent_[static_cast<std::size_t>(parent_[at])];
    at = static_cast<std::size_t>(parent_[at]);
  }
  return static_cast<LocalIndex>(at);
}

int Spots::count(LocalIndex v, LocalIndex label)
{
  collect_link(v, label);
  if (link_.empty()) return 0;
  vertices_.clear();
  parent_.clear();
  int num_components = 0;
  for (const LinkEdge& edge : link_) {
    const LocalIndex a = root_of(node_of(edge.a));
    const LocalIndex b = root_of(node_of(edge.b));
    if (a == b) continue;
    parent_[static_cast<std::size_t>(b)] = a;
    --num_components;
  }
  const int num_nodes = static_cast<int>(vertices_.size());
  num_components += num_nodes;
  for (const LocalIndex vertex : vertices_) node_[static_cast<std::size_t>(vertex)] = kNoIndex;
  return static_cast<int>(link_.size()) - num_nodes + num_components - 1;
}

int Spots::count_at_tet(LocalIndex t, LocalIndex label, LocalIndex other_label)
{
  int sum = 0;
  for (const LocalIndex v : graph_->vertices(t)) sum += count(v, label) + count(v, other_label);
  return sum;
}

std::span<const LocalIndex> Spots::labels_at(LocalIndex v)
{
  labels_.clear();
  for (const LocalIndex t : graph_->tets_at(v)) labels_.push_back(labelling_->of(t));
  std::sort(labels_.begin(), labels_.end());
  labels_.erase(std::unique(labels_.begin(), labels_.end()), labels_.end());
  return labels_;
}

void Spots::compute_total(LocalIndex v)
{
  int sum = 0;
  for (const LocalIndex label : labels_at(v)) sum += count(v, label);
  total_[static_cast<std::size_t>(v)] = sum;
}

void Spots::refresh(std::span<const LocalIndex> tets)
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

LocalIndex Spots::pinched_edge(LocalIndex v, LocalIndex label)
{
  collect_link(v, label);
  std::vector<LocalIndex> ends;
  for (const LinkEdge& edge : link_) ends.insert(ends.end(), {edge.a, edge.b});
  std::sort(ends.begin(), ends.end());
  for (std::size_t i = 2; i < ends.size(); ++i) {
    if (ends[i] == ends[i - 2]) return ends[i];  // two triangles are the rule
  }
  return kNoIndex;
}

}  // namespace tessera::decompose
