// SPDX-License-Identifier: BSD-3-Clause
#include "decompose/repair/repair.hpp"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "decompose/repair/non_manifold_vertices.hpp"
#include "decompose/repair/regions.hpp"
#include "decompose/repair/seam_mover.hpp"
#include "decompose/repair/skin_components.hpp"

namespace tessera::decompose {
namespace {

// Two connected sets of tets of one part that must not stay together.
struct Separation {
  LocalIndex part = kNoIndex;
  std::vector<LocalIndex> first{};
  std::vector<LocalIndex> second{};
};

class Splitter {
 public:
  Splitter(const TetGraph& graph, TetPartition& partition, NonManifoldVertices& non_manifold)
      : graph_(&graph),
        partition_(&partition),
        non_manifold_(&non_manifold),
        search_(graph),
        skins_(graph)
  {
  }

  // Splits every part with a non-manifold vertex once; if there is none, every part with a cavity.
  // Returns the tets of all parts that were split.
  std::vector<LocalIndex> run(LocalIndex& num_splits)
  {
    std::vector<Separation> separations = separations_at_non_manifold();
    const IndexLists part_tets = tets_of_parts(*partition_);
    if (separations.empty()) separations = separations_at_cavities(part_tets);
    std::vector<LocalIndex> changed;
    for (const Separation& separation : separations) {
      const auto tets = part_tets[separation.part];
      const LocalIndex new_part = partition_->add_part();
      for (const LocalIndex t : search_.cut(tets, separation.first, separation.second)) {
        partition_->assign(t, new_part);
      }
      changed.insert(changed.end(), tets.begin(), tets.end());
    }
    non_manifold_->refresh(changed);
    num_splits += static_cast<LocalIndex>(separations.size());
    return changed;
  }

 private:
  std::vector<Separation> separations_at_non_manifold()
  {
    std::vector<Separation> separations;
    std::vector<bool> is_done(static_cast<std::size_t>(partition_->num_parts()), false);
    for (LocalIndex v = 0; v < graph_->num_vertices(); ++v) {
      if (non_manifold_->total(v) == 0) continue;
      for (const LocalIndex part : non_manifold_->parts_at(v)) {
        if (is_done[static_cast<std::size_t>(part)] || non_manifold_->count(v, part) == 0) continue;
        is_done[static_cast<std::size_t>(part)] = true;
        separations.push_back(separation_at(v, part));
      }
    }
    return separations;
  }

  // Two fans at the vertex; else two wedges at an edge of it; else (one fan, bounded by two rings)
  // halves of the fan.
  Separation separation_at(LocalIndex v, LocalIndex part)
  {
    std::vector<LocalIndex> star;
    for (const LocalIndex t : graph_->tets_at(v)) {
      if (partition_->of(t) == part) star.push_back(t);
    }
    auto parts = search_.components(star);
    if (parts.size() < 2) {
      const LocalIndex end = non_manifold_->pinched_edge(v, part);
      std::vector<LocalIndex> around_edge;
      for (const LocalIndex t : star) {
        const auto vertices = graph_->vertices(t);
        const bool has_end = std::find(vertices.begin(), vertices.end(), end) != vertices.end();
        if (has_end) around_edge.push_back(t);
      }
      parts = search_.components(around_edge);
    }
    if (parts.size() < 2) {
      parts = {star, search_.halve(star)};
      std::erase_if(parts[0], [&](LocalIndex t) {
        return std::find(parts[1].begin(), parts[1].end(), t) != parts[1].end();
      });
    }
    return {part, std::move(parts[0]), std::move(parts[1])};
  }

  // A cut from one end of the cavity to the other opens it.
  std::vector<Separation> separations_at_cavities(const IndexLists& part_tets)
  {
    std::vector<Separation> separations;
    for (LocalIndex part = 0; part < partition_->num_parts(); ++part) {
      const auto tets = part_tets[part];
      if (tets.empty()) continue;
      const auto at_cavity = skins_.tets_at_cavity(*partition_, tets);
      if (at_cavity.empty()) continue;
      const LocalIndex first = at_cavity.front();
      const auto order = search_.reach(tets, first);
      const auto last_at_cavity = std::find_if(order.rbegin(), order.rend(), [&](LocalIndex t) {
        return std::binary_search(at_cavity.begin(), at_cavity.end(), t);
      });
      const LocalIndex second = *last_at_cavity == first ? order.back() : *last_at_cavity;
      separations.push_back({part, {first}, {second}});
    }
    return separations;
  }

  const TetGraph* graph_;
  TetPartition* partition_;
  NonManifoldVertices* non_manifold_;
  RegionSearch search_;
  SkinComponents skins_;
};

}  // namespace

RepairCounts repair(const TetGraph& graph, TetPartition& partition)
{
  RepairCounts counts;
  NonManifoldVertices non_manifold(graph, partition);
  SeamMover mover(graph, partition, non_manifold);
  Splitter splitter(graph, partition, non_manifold);
  std::vector<LocalIndex> changed(static_cast<std::size_t>(graph.num_tets()));
  std::iota(changed.begin(), changed.end(), 0);
  while (!changed.empty()) {
    counts.num_moves += mover.run(changed);
    changed = splitter.run(counts.num_splits);
  }
  return counts;
}

}  // namespace tessera::decompose
