// SPDX-License-Identifier: BSD-3-Clause
#include "decompose/repair.hpp"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "decompose/regions.hpp"
#include "decompose/seam_mover.hpp"
#include "decompose/skin_components.hpp"
#include "decompose/spots.hpp"

namespace tessera::decompose {
namespace {

// Two connected sets of tets of one label that must not stay together.
struct Separation {
  LocalIndex label = kNoIndex;
  std::vector<LocalIndex> first{};
  std::vector<LocalIndex> second{};
};

class Splitter {
 public:
  Splitter(const TetGraph& graph, Labelling& labelling, Spots& spots)
      : graph_(&graph), labelling_(&labelling), spots_(&spots), search_(graph), skins_(graph)
  {
  }

  // Splits every label with a spot once; if there is none, every label with a cavity. Returns the
  // tets of all labels that were split.
  std::vector<LocalIndex> run(LocalIndex& num_splits)
  {
    std::vector<Separation> separations = separations_at_spots();
    const LabelTets label_tets = tets_of_labels(*graph_, *labelling_);
    if (separations.empty()) separations = separations_at_cavities(label_tets);
    std::vector<LocalIndex> changed;
    for (const Separation& separation : separations) {
      const auto tets = label_tets.of(separation.label);
      const LocalIndex new_label = labelling_->add_label();
      for (const LocalIndex t : search_.cut(tets, separation.first, separation.second)) {
        labelling_->assign(t, new_label);
      }
      changed.insert(changed.end(), tets.begin(), tets.end());
    }
    spots_->refresh(changed);
    num_splits += static_cast<LocalIndex>(separations.size());
    return changed;
  }

 private:
  std::vector<Separation> separations_at_spots()
  {
    std::vector<Separation> separations;
    std::vector<bool> is_done(static_cast<std::size_t>(labelling_->num_labels()), false);
    for (LocalIndex v = 0; v < graph_->num_vertices(); ++v) {
      if (spots_->total(v) == 0) continue;
      for (const LocalIndex label : spots_->labels_at(v)) {
        if (is_done[static_cast<std::size_t>(label)] || spots_->count(v, label) == 0) continue;
        is_done[static_cast<std::size_t>(label)] = true;
        separations.push_back(separation_at(v, label));
      }
    }
    return separations;
  }

  // Two fans at the vertex; else two wedges at an edge of it; else (one fan, bounded by two rings)
  // halves of the fan.
  Separation separation_at(LocalIndex v, LocalIndex label)
  {
    std::vector<LocalIndex> star;
    for (const LocalIndex t : graph_->tets_at(v)) {
      if (labelling_->of(t) == label) star.push_back(t);
    }
    auto parts = search_.components(star);
    if (parts.size() < 2) {
      const LocalIndex end = spots_->pinched_edge(v, label);
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
    return {label, std::move(parts[0]), std::move(parts[1])};
  }

  // A cut from one end of the cavity to the other opens it.
  std::vector<Separation> separations_at_cavities(const LabelTets& label_tets)
  {
    std::vector<Separation> separations;
    for (LocalIndex label = 0; label < labelling_->num_labels(); ++label) {
      const auto tets = label_tets.of(label);
      if (tets.empty()) continue;
      const auto at_cavity = skins_.tets_at_cavity(*labelling_, tets);
      if (at_cavity.empty()) continue;
      const LocalIndex first = at_cavity.front();
      const auto order = search_.reach(tets, first);
      const auto last_at_cavity = std::find_if(order.rbegin(), order.rend(), [&](LocalIndex t) {
        return std::binary_search(at_cavity.begin(), at_cavity.end(), t);
      });
      const LocalIndex second = *last_at_cavity == first ? order.back() : *last_at_cavity;
      separations.push_back({label, {first}, {second}});
    }
    return separations;
  }

  const TetGraph* graph_;
  Labelling* labelling_;
  Spots* spots_;
  RegionSearch search_;
  SkinComponents skins_;
};

}  // namespace

RepairCounts repair(const TetGraph& graph, Labelling& labelling)
{
  RepairCounts counts;
  Spots spots(graph, labelling);
  SeamMover mover(graph, labelling, spots);
  Splitter splitter(graph, labelling, spots);
  std::vector<LocalIndex> changed(static_cast<std::size_t>(graph.num_tets()));
  std::iota(changed.begin(), changed.end(), 0);
  while (!changed.empty()) {
    counts.num_moves += mover.run(changed);
    changed = splitter.run(counts.num_splits);
  }
  return counts;
}

}  // namespace tessera::decompose
