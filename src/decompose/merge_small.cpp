// SPDX-License-Identifier: BSD-3-Clause
#include "decompose/merge_small.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <vector>

#include "decompose/skin_components.hpp"
#include "decompose/spots.hpp"

namespace tessera::decompose {
namespace {

// Labels lighter than this share of the wanted mean look for a neighbour that takes them up, as
// long as the two together stay below the second share.
constexpr double kSmallShare = 0.5;
constexpr double kLargestShare = 1.2;

class Merger {
 public:
  Merger(const TetGraph& graph, Labelling& labelling, LocalIndex num_wanted)
      : graph_(&graph),
        labelling_(&labelling),
        num_wanted_(num_wanted),
        wanted_weight_(labelling.mean_weight() * labelling.num_used() / num_wanted),
        spots_(graph, labelling),
        skins_(graph),
        is_hopeless_(static_cast<std::size_t>(labelling.num_labels()), false)
  {
  }

  // One round: each label takes part in one merge at most, so that the lists of tets stay true.
  LocalIndex run_round()
  {
    const LabelTets label_tets = tets_of_labels(*graph_, *labelling_);
    std::vector<bool> is_changed(static_cast<std::size_t>(labelling_->num_labels()), false);
    LocalIndex num_merges = 0;
    for (const LocalIndex label : small_labels()) {
      if (labelling_->num_used() <= num_wanted_) break;
      if (is_changed[static_cast<std::size_t>(label)]) continue;
      const auto neighbours = neighbours_of(label_tets.of(label));
      is_hopeless_[static_cast<std::size_t>(label)] = true;
      for (const LocalIndex other : neighbours) {
        if (is_changed[static_cast<std::size_t>(other)]) {
          is_hopeless_[static_cast<std::size_t>(label)] = false;
          continue;
        }
        if (!try_merge(label_tets.of(label), label_tets.of(other))) continue;
        is_changed[static_cast<std::size_t>(label)] = true;
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
  [[nodiscard]] std::vector<LocalIndex> small_labels() const
  {
    std::vector<LocalIndex> labels;
    for (LocalIndex label = 0; label < labelling_->num_labels(); ++label) {
      if (is_hopeless_[static_cast<std::size_t>(label)]) continue;
      const bool is_used = labelling_->num_tets(label) > 0;
      const bool is_small = labelling_->weight(label) < kSmallShare * wanted_weight_;
      if (is_used && is_small) labels.push_back(label);
    }
    std::stable_sort(labels.begin(), labels.end(), [&](LocalIndex a, LocalIndex b) {
      return labelling_->weight(a) < labelling_->weight(b);
    });
    return labels;
  }

  // Neighbour labels, the one with the most expensive seam first.
  [[nodiscard]] std::vector<LocalIndex> neighbours_of(std::span<const LocalIndex> tets) const
  {
    struct Contact {
      LocalIndex label;
      std::int64_t price;
    };
    const LocalIndex own = labelling_->of(tets.front());
    std::vector<Contact> contacts;
    for (const LocalIndex t : tets) {
      for (std::size_t face = 0; face < 4; ++face) {
        const LocalIndex neighbour = graph_->neighbours(t)[face];
        if (neighbour == kNoIndex || labelling_->of(neighbour) == own) continue;
        const LocalIndex label = labelling_->of(neighbour);
        auto contact = std::find_if(contacts.begin(), contacts.end(),
                                    [&](const Contact& c) { return c.label == label; });
        if (contact == contacts.end()) contact = contacts.insert(contact, {label, 0});
        contact->price += graph_->face_cost(t)[face];
      }
    }
    std::sort(contacts.begin(), contacts.end(), [](const Contact& a, const Contact& b) {
      return a.price != b.price ? a.price > b.price : a.label < b.label;
    });
    std::vector<LocalIndex> labels;
    labels.reserve(contacts.size());
    for (const Contact& contact : contacts) labels.push_back(contact.label);
    return labels;
  }

  bool try_merge(std::span<const LocalIndex> small, std::span<const LocalIndex> large)
  {
    const LocalIndex from = labelling_->of(small.front());
    const LocalIndex to = labelling_->of(large.front());
    const double sum = labelling_->weight(from) + labelling_->weight(to);
    if (sum > kLargestShare * wanted_weight_) return false;
    for (const LocalIndex t : small) labelling_->pretend(t, to);
    const bool is_good = is_one_surface(small, large);
    for (const LocalIndex t : small) labelling_->pretend(t, from);
    if (!is_good) return false;
    for (const LocalIndex t : small) labelling_->assign(t, to);
    return true;
  }

  // Of the union, already labelled as one.
  bool is_one_surface(std::span<const LocalIndex> small, std::span<const LocalIndex> large)
  {
    const LocalIndex label = labelling_->of(large.front());
    std::vector<LocalIndex> vertices;
    for (const LocalIndex t : small) {
      const auto corners = graph_->vertices(t);
      vertices.insert(vertices.end(), corners.begin(), corners.end());
    }
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    const auto is_spot = [&](LocalIndex v) { return spots_.count(v, label) > 0; };
    if (std::any_of(vertices.begin(), vertices.end(), is_spot)) return false;
    std::vector<LocalIndex> tets;
    std::merge(small.begin(), small.end(), large.begin(), large.end(), std::back_inserter(tets));
    return skins_.tets_at_cavity(*labelling_, tets).empty();
  }

  const TetGraph* graph_;
  Labelling* labelling_;
  LocalIndex num_wanted_;
  double wanted_weight_;
  Spots spots_;
  SkinComponents skins_;
  std::vector<bool> is_hopeless_;  // tried in vain, and nothing next to it has changed since
};

}  // namespace

LocalIndex merge_small(const TetGraph& graph, Labelling& labelling, LocalIndex num_wanted)
{
  if (labelling.num_used() <= num_wanted) return 0;
  Merger merger(graph, labelling, num_wanted);
  LocalIndex sum = 0;
  for (LocalIndex now = merger.run_round(); now > 0; now = merger.run_round()) sum += now;
  return sum;
}

}  // namespace tessera::decompose
