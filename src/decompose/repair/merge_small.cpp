// SPDX-License-Identifier: BSD-3-Clause
#include "decompose/repair/merge_small.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <vector>

#include "decompose/repair/non_manifold_vertices.hpp"
#include "decompose/repair/skin_components.hpp"

namespace tessera::decompose {
namespace {

// Parts lighter than this share of the wanted mean look for a neighbour that takes them up, as
// long as the two together stay below the second share.
constexpr double kSmallShare = 0.5;
constexpr double kLargestShare = 1.2;

class Merger {
 public:
  Merger(const TetGraph& graph, TetPartition& partition, LocalIndex num_wanted)
      : graph_(&graph),
        partition_(&partition),
        num_wanted_(num_wanted),
        wanted_weight_(partition.mean_weight() * partition.num_used() / num_wanted),
        non_manifold_(graph, partition),
        skins_(graph),
        is_hopeless_(static_cast<std::size_t>(partition.num_parts()), false)
  {
  }

  // One round: each part takes part in one merge at most, so that the lists of tets stay true.
  LocalIndex run_round()
  {
    const IndexLists part_tets = tets_of_parts(*partition_);
    std::vector<bool> is_changed(static_cast<std::size_t>(partition_->num_parts()), false);
    LocalIndex num_merges = 0;
    for (const LocalIndex part : small_parts()) {
      if (partition_->num_used() <= num_wanted_) break;
      if (is_changed[static_cast<std::size_t>(part)]) continue;
      const auto neighbours = neighbours_of(part_tets[part]);
      is_hopeless_[static_cast<std::size_t>(part)] = true;
      for (const LocalIndex other : neighbours) {
        if (is_changed[static_cast<std::size_t>(other)]) {
          is_hopeless_[static_cast<std::size_t>(part)] = false;
          continue;
        }
        if (!try_merge(part_tets[part], part_tets[other])) continue;
        is_changed[static_cast<std::size_t>(part)] = true;
        is_changed[static_cast<std::size_t>(other)] = true;
        for (const LocalIndex n : neighbours) is_hopeless_[static_cast<std::size_t>(n)] = false;
        ++num_merges;
        break;
      }
    }
    return num_merges;
  }

 private:
  // Those worth a try, lightest first.
  [[nodiscard]] std::vector<LocalIndex> small_parts() const
  {
    std::vector<LocalIndex> parts;
    for (LocalIndex part = 0; part < partition_->num_parts(); ++part) {
      if (is_hopeless_[static_cast<std::size_t>(part)]) continue;
      const bool is_used = partition_->num_tets(part) > 0;
      const bool is_small = partition_->weight(part) < kSmallShare * wanted_weight_;
      if (is_used && is_small) parts.push_back(part);
    }
    std::stable_sort(parts.begin(), parts.end(), [&](LocalIndex a, LocalIndex b) {
      return partition_->weight(a) < partition_->weight(b);
    });
    return parts;
  }

  // Neighbour parts, the one with the most expensive seam first.
  [[nodiscard]] std::vector<LocalIndex> neighbours_of(std::span<const LocalIndex> tets) const
  {
    struct Contact {
      LocalIndex part;
      std::int64_t price;
    };
    const LocalIndex own = partition_->of(tets.front());
    std::vector<Contact> contacts;
    for (const LocalIndex t : tets) {
      for (std::size_t face = 0; face < 4; ++face) {
        const LocalIndex neighbour = graph_->neighbours(t)[face];
        if (neighbour == kNoIndex || partition_->of(neighbour) == own) continue;
        const LocalIndex part = partition_->of(neighbour);
        auto contact = std::find_if(contacts.begin(), contacts.end(),
                                    [&](const Contact& c) { return c.part == part; });
        if (contact == contacts.end()) contact = contacts.insert(contact, {part, 0});
        contact->price += graph_->face_cost(t)[face];
      }
    }
    std::sort(contacts.begin(), contacts.end(), [](const Contact& a, const Contact& b) {
      return a.price != b.price ? a.price > b.price : a.part < b.part;
    });
    std::vector<LocalIndex> parts;
    parts.reserve(contacts.size());
    for (const Contact& contact : contacts) parts.push_back(contact.part);
    return parts;
  }

  bool try_merge(std::span<const LocalIndex> small, std::span<const LocalIndex> large)
  {
    const LocalIndex from = partition_->of(small.front());
    const LocalIndex to = partition_->of(large.front());
    const double sum = partition_->weight(from) + partition_->weight(to);
    if (sum > kLargestShare * wanted_weight_) return false;
    for (const LocalIndex t : small) partition_->pretend(t, to);
    const bool is_good = is_one_surface(small, large);
    for (const LocalIndex t : small) partition_->pretend(t, from);
    if (!is_good) return false;
    for (const LocalIndex t : small) partition_->assign(t, to);
    return true;
  }

  // Of the union, already labelled as one.
  bool is_one_surface(std::span<const LocalIndex> small, std::span<const LocalIndex> large)
  {
    const LocalIndex part = partition_->of(large.front());
    std::vector<LocalIndex> vertices;
    for (const LocalIndex t : small) {
      const auto corners = graph_->vertices(t);
      vertices.insert(vertices.end(), corners.begin(), corners.end());
    }
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    const auto is_non_manifold = [&](LocalIndex v) { return non_manifold_.count(v, part) > 0; };
    if (std::any_of(vertices.begin(), vertices.end(), is_non_manifold)) return false;
    std::vector<LocalIndex> tets;
    std::merge(small.begin(), small.end(), large.begin(), large.end(), std::back_inserter(tets));
    return skins_.tets_at_cavity(*partition_, tets).empty();
  }

  const TetGraph* graph_;
  TetPartition* partition_;
  LocalIndex num_wanted_;
  double wanted_weight_;
  NonManifoldVertices non_manifold_;
  SkinComponents skins_;
  std::vector<bool> is_hopeless_;  // tried in vain, and nothing next to it has changed since
};

}  // namespace

LocalIndex merge_small(const TetGraph& graph, TetPartition& partition, LocalIndex num_wanted)
{
  if (partition.num_used() <= num_wanted) return 0;
  Merger merger(graph, partition, num_wanted);
  LocalIndex sum = 0;
  for (LocalIndex now = merger.run_round(); now > 0; now = merger.run_round()) sum += now;
  return sum;
}

}  // namespace tessera::decompose
