// SPDX-License-Identifier: BSD-3-Clause
#include "migrate/partition/part_graph.hpp"

#include <algorithm>
#include <deque>
#include <numeric>
#include <optional>

namespace tessera::migrate {
namespace {

class Planner {
 public:
  Planner(const PartGraph& graph, GlobalIndex largest_allowed,
          const std::set<std::pair<LocalIndex, LocalIndex>>& banned)
      : graph_(graph), largest_allowed_(largest_allowed), banned_(banned)
  {
    const auto num_parts = static_cast<GlobalIndex>(graph.sizes.size());
    average_ = std::accumulate(graph.sizes.begin(), graph.sizes.end(), num_parts - 1) / num_parts;
    is_busy_.assign(graph.sizes.size(), false);
  }

  std::vector<Transfer> plan()
  {
    std::vector<LocalIndex> order(graph_.sizes.size());
    std::iota(order.begin(), order.end(), 0);
    std::ranges::stable_sort(order, std::greater<>(), [&](LocalIndex p) { return size(p); });
    std::vector<Transfer> transfers;
    for (const LocalIndex part : order) {
      if (size(part) <= largest_allowed_) break;
      if (is_busy_[at(part)]) continue;
      const auto transfer = last_step(part);
      if (!transfer) continue;
      is_busy_[at(transfer->from)] = true;
      is_busy_[at(transfer->to)] = true;
      transfers.push_back(*transfer);
    }
    return transfers;
  }

 private:
  [[nodiscard]] GlobalIndex size(LocalIndex part) const { return graph_.sizes[at(part)]; }

  // Breadth first from a part that is too large to the nearest with room.
  [[nodiscard]] std::optional<Transfer> last_step(LocalIndex large) const
  {
    std::vector<bool> is_seen(graph_.sizes.size(), false);
    is_seen[at(large)] = true;
    std::deque<LocalIndex> queue{large};
    for (; !queue.empty(); queue.pop_front()) {
      const LocalIndex part = queue.front();
      for (const LocalIndex next : graph_.neighbours[part]) {
        if (is_seen[at(next)] || is_busy_[at(next)] || banned_.contains({part, next})) continue;
        is_seen[at(next)] = true;
        if (size(next) < average_) {
          const GlobalIndex excess = size(large) - largest_allowed_;
          return Transfer{part, next, std::min(excess, average_ - size(next))};
        }
        queue.push_back(next);
      }
    }
    return std::nullopt;
  }

  const PartGraph& graph_;
  GlobalIndex largest_allowed_;
  const std::set<std::pair<LocalIndex, LocalIndex>>& banned_;
  GlobalIndex average_ = 0;  // Rounded up.
  std::vector<bool> is_busy_{};
};

}  // namespace

std::vector<Transfer> plan_transfers(const PartGraph& graph, GlobalIndex largest_allowed,
                                     const std::set<std::pair<LocalIndex, LocalIndex>>& banned)
{
  return Planner(graph, largest_allowed, banned).plan();
}

}  // namespace tessera::migrate
