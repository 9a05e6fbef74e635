// SPDX-License-Identifier: BSD-3-Clause
#include "migrate/part_view.hpp"

#include <algorithm>
#include <compare>
#include <map>
#include <queue>
#include <set>
#include <tuple>
#include <utility>

#include "tessera/base/union_find.hpp"

namespace tessera::migrate {
namespace {

// Grows a set of tets of one part from its triangles with another part inwards. Tets that lose most
// triangles towards the other part come first, which keeps the new surface small.
class Peeling {
 public:
  Peeling(const PartView& view, const Transfer& transfer)
      : view_(view), transfer_(transfer), is_taken_(at(view.num_tets()), false)
  {
    for (LocalIndex t = 0; t < view.num_tets(); ++t) {
      if (view.part(t) == transfer.from && num_sides_taken(t) > 0) push(t);
    }
  }

  // As many as asked for, if there are.
  std::vector<LocalIndex> take(GlobalIndex num_tets)
  {
    std::vector<LocalIndex> taken;
    while (!queue_.empty() && std::cmp_less(taken.size(), num_tets)) {
      const auto [gain, negative_tet] = queue_.top();
      queue_.pop();
      const LocalIndex tet = -negative_tet;
      if (is_taken_[at(tet)] || gain != gain_of(tet)) continue;  // Older than its neighbours.
      is_taken_[at(tet)] = true;
      taken.push_back(tet);
      for (std::size_t c = 0; c < 4; ++c) {
        const LocalIndex next = view_.tet_behind(tet, c);
        if (next == kNoIndex || view_.part(next) != transfer_.from) continue;
        if (!is_taken_[at(next)]) push(next);
      }
    }
    return taken;
  }

 private:
  [[nodiscard]] int num_sides_taken(LocalIndex tet) const
  {
    int num = 0;
    for (std::size_t c = 0; c < 4; ++c) {
      const LocalIndex next = view_.tet_behind(tet, c);
      const bool is_taken = next != kNoIndex && is_taken_[at(next)];
      if (is_taken || view_.part_behind(tet, c) == transfer_.to) ++num;
    }
    return num;
  }

  // Triangles towards the other part, less those that would newly be cut.
  [[nodiscard]] int gain_of(LocalIndex tet) const
  {
    int num_own = 0;
    for (std::size_t c = 0; c < 4; ++c) {
      const LocalIndex next = view_.tet_behind(tet, c);
      if (next != kNoIndex && view_.part(next) == transfer_.from && !is_taken_[at(next)]) ++num_own;
    }
    return num_sides_taken(tet) - num_own;
  }

  void push(LocalIndex tet) { queue_.emplace(gain_of(tet), -tet); }

  const PartView& view_;
  const Transfer& transfer_;
  std::vector<bool> is_taken_;
  std::priority_queue<std::pair<int, LocalIndex>> queue_{};  // Of equal gain, the lowest tet first.
};

// Adds what the part would lose its connection to: all but the largest of what is left in it.
void take_cut_off(const PartView& view, LocalIndex from, std::vector<LocalIndex>& taken)
{
  std::vector<bool> is_left(at(view.num_tets()), false);
  for (LocalIndex t = 0; t < view.num_tets(); ++t) is_left[at(t)] = view.part(t) == from;
  for (const LocalIndex t : taken) is_left[at(t)] = false;
  UnionFind sets(view.num_tets());
  for (LocalIndex t = 0; t < view.num_tets(); ++t) {
    if (!is_left[at(t)]) continue;
    for (std::size_t c = 0; c < 4; ++c) {
      const LocalIndex next = view.tet_behind(t, c);
      if (next != kNoIndex && is_left[at(next)]) sets.join(t, next);
    }
  }
  std::map<LocalIndex, GlobalIndex> sizes;
  for (LocalIndex t = 0; t < view.num_tets(); ++t) {
    if (is_left[at(t)]) ++sizes[sets.find(t)];
  }
  if (sizes.size() < 2) return;
  const LocalIndex largest =
      std::ranges::max_element(sizes, {}, [](const auto& entry) { return entry.second; })->first;
  for (LocalIndex t = 0; t < view.num_tets(); ++t) {
    if (is_left[at(t)] && sets.find(t) != largest) taken.push_back(t);
  }
}

}  // namespace

PartView::PartView(const comm::Communicator& comm, const TetNeighbours& neighbours,
                   std::vector<LocalIndex> tet_part)
    : neighbours_(neighbours), tet_part_(std::move(tet_part))
{
  remote_part_ = values_behind(comm, neighbours, {tet_part_.begin(), tet_part_.end()});
}

std::vector<LocalIndex> components_of_parts(const PartView& view)
{
  UnionFind sets(view.num_tets());
  for (LocalIndex t = 0; t < view.num_tets(); ++t) {
    for (std::size_t c = 0; c < 4; ++c) {
      const LocalIndex next = view.tet_behind(t, c);
      if (next != kNoIndex && view.part(next) == view.part(t)) sets.join(t, next);
    }
  }
  std::vector<LocalIndex> component(at(view.num_tets()));
  for (LocalIndex t = 0; t < view.num_tets(); ++t) component[at(t)] = sets.find(t);
  return component;
}

namespace {

// Two parts that are beside each other.
struct PartPair {
  LocalIndex part = 0;
  LocalIndex other = 0;

  static auto fields(auto& self) { return std::tie(self.part, self.other); }

  friend auto operator<=>(const PartPair&, const PartPair&) = default;
};

}  // namespace

PartGraph graph_of_parts(const comm::Communicator& comm, const PartView& view, LocalIndex num_parts)
{
  PartGraph graph;
  graph.sizes.assign(at(num_parts), 0);
  std::set<PartPair> pairs;
  for (LocalIndex t = 0; t < view.num_tets(); ++t) {
    ++graph.sizes[at(view.part(t))];
    for (std::size_t c = 0; c < 4; ++c) {
      const LocalIndex other = view.part_behind(t, c);
      if (other != kNoPart && other != view.part(t)) pairs.insert({view.part(t), other});
    }
  }
  comm.sum_in_place(graph.sizes);
  const std::vector<PartPair> own_pairs(pairs.begin(), pairs.end());
  // Ranks have ascending ranges of parts, so the pairs of all ranks ascend as well.
  LocalIndex last = 0;
  for (const auto& [part, other] : comm.all_gather_rows(own_pairs)) {
    for (; last < part; ++last) graph.neighbours.end_list();
    graph.neighbours.values.push_back(other);
  }
  for (; last < num_parts; ++last) graph.neighbours.end_list();
  return graph;
}

std::vector<LocalIndex> choose_tets(const PartView& view, const Transfer& transfer,
                                    GlobalIndex max_tets)
{
  for (GlobalIndex wish = transfer.num_tets; wish > 0; wish /= 2) {
    std::vector<LocalIndex> taken = Peeling(view, transfer).take(wish);
    take_cut_off(view, transfer.from, taken);
    if (std::cmp_less_equal(taken.size(), max_tets)) return taken;
  }
  return {};
}

}  // namespace tessera::migrate
