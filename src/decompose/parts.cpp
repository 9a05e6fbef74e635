// SPDX-License-Identifier: BSD-3-Clause
#include "decompose/parts.hpp"

#include <algorithm>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>

#include "decompose/partition/checked_partition.hpp"

namespace tessera::decompose {
namespace {

// Parts within this of the average are left alone: every move lengthens the cut.
constexpr double kBalance = 1.01;

class Parts {
 public:
  Parts(const Graph& graph, LocalIndex num_parts, std::vector<LocalIndex> part)
      : graph_(graph), part_(std::move(part)), weight_(at(num_parts), 0), size_(at(num_parts), 0)
  {
    for (LocalIndex v = 0; v < graph.num_vertices(); ++v) {
      weight_[at(part_[at(v)])] += graph.vertex_weight[at(v)];
      ++size_[at(part_[at(v)])];
    }
  }

  // Every move unites two components, so it ends.
  void connect()
  {
    for (bool has_moved = true; has_moved;) {
      has_moved = false;
      for (const Component& component : components()) {
        if (component.is_heaviest) continue;
        const LocalIndex to = best_neighbour(component.vertices);
        if (to == kNoIndex) continue;
        for (const LocalIndex v : component.vertices) move(v, to);
        has_moved = true;
        break;  // The other components may have changed.
      }
    }
  }

  // Every move makes the sum of squared weights smaller, so it ends.
  void balance()
  {
    std::int64_t total = 0;
    for (const std::int64_t weight : weight_) total += weight;
    const double limit =
        kBalance * static_cast<double>(total) / static_cast<double>(weight_.size());
    while (const auto step = best_move(limit)) move(step->vertex, step->to);
  }

  [[nodiscard]] std::vector<LocalIndex> take() && { return std::move(part_); }

 private:
  struct Component {
    LocalIndex part = kNoIndex;
    std::int64_t weight = 0;
    std::vector<LocalIndex> vertices{};
    bool is_heaviest = false;  ///< Of its part.
  };

  struct Move {
    LocalIndex vertex = kNoIndex;
    LocalIndex to = kNoIndex;
    std::int64_t gain = 0;  ///< Fall of the sum of squares, halved.
  };

  void move(LocalIndex v, LocalIndex to)
  {
    LocalIndex& from = part_[at(v)];
    weight_[at(from)] -= graph_.vertex_weight[at(v)];
    weight_[at(to)] += graph_.vertex_weight[at(v)];
    --size_[at(from)];
    ++size_[at(to)];
    from = to;
  }

  template <class Visit>
  void for_each_neighbour(LocalIndex v, const Visit& visit) const
  {
    for (LocalIndex e = graph_.offsets[at(v)]; e < graph_.offsets[at(v) + 1]; ++e) {
      visit(graph_.neighbours[at(e)], graph_.edge_weight[at(e)]);
    }
  }

  // The vertices of v's part that can be reached from v without passing through `left_out`.
  [[nodiscard]] std::vector<LocalIndex> reached_from(LocalIndex v, LocalIndex left_out) const
  {
    std::vector<char> is_reached(part_.size(), 0);
    std::vector<LocalIndex> reached{v};
    is_reached[at(v)] = 1;
    for (std::size_t next = 0; next < reached.size(); ++next) {
      for_each_neighbour(reached[next], [&](LocalIndex w, std::int32_t) {
        if (is_reached[at(w)] != 0 || w == left_out || part_[at(w)] != part_[at(v)]) return;
        is_reached[at(w)] = 1;
        reached.push_back(w);
      });
    }
    return reached;
  }

  [[nodiscard]] std::vector<Component> components() const
  {
    std::vector<Component> all;
    std::vector<char> is_seen(part_.size(), 0);
    for (LocalIndex v = 0; v < graph_.num_vertices(); ++v) {
      if (is_seen[at(v)] != 0) continue;
      Component component{.part = part_[at(v)], .vertices = reached_from(v, kNoIndex)};
      for (const LocalIndex w : component.vertices) {
        is_seen[at(w)] = 1;
        component.weight += graph_.vertex_weight[at(w)];
      }
      all.push_back(std::move(component));
    }
    std::vector<const Component*> best(weight_.size(), nullptr);
    for (const Component& component : all) {
      const Component*& there = best[at(component.part)];
      if (there == nullptr || there->weight < component.weight) there = &component;
    }
    for (Component& component : all) component.is_heaviest = best[at(component.part)] == &component;
    return all;
  }

  [[nodiscard]] LocalIndex best_neighbour(const std::vector<LocalIndex>& vertices) const
  {
    std::map<LocalIndex, std::int64_t> contact;
    for (const LocalIndex v : vertices) {
      for_each_neighbour(v, [&](LocalIndex w, std::int32_t weight) {
        if (part_[at(w)] != part_[at(v)]) contact[part_[at(w)]] += weight;
      });
    }
    const auto best =
        std::ranges::max_element(contact, {}, [](const auto& entry) { return entry.second; });
    return best == contact.end() ? kNoIndex : best->first;
  }

  [[nodiscard]] bool stays_connected_without(LocalIndex v) const
  {
    const LocalIndex rest = size_[at(part_[at(v)])] - 1;
    if (rest == 0) return false;
    LocalIndex start = kNoIndex;
    for_each_neighbour(v, [&](LocalIndex w, std::int32_t) {
      if (start == kNoIndex && part_[at(w)] == part_[at(v)]) start = w;
    });
    if (start == kNoIndex) return true;  // It was a component of its own.
    return static_cast<LocalIndex>(reached_from(start, v).size()) == rest;
  }

  // The move from a part above the limit that makes parts most alike.
  [[nodiscard]] std::optional<Move> best_move(double limit) const
  {
    Move best;
    for (LocalIndex v = 0; v < graph_.num_vertices(); ++v) {
      const std::int64_t from = weight_[at(part_[at(v)])];
      if (static_cast<double>(from) <= limit) continue;
      const std::int64_t weight = graph_.vertex_weight[at(v)];
      for_each_neighbour(v, [&](LocalIndex w, std::int32_t) {
        const LocalIndex to = part_[at(w)];
        if (to == part_[at(v)]) return;
        const std::int64_t gain = weight * (from - weight_[at(to)] - weight);
        if (gain > best.gain && stays_connected_without(v)) best = {v, to, gain};
      });
    }
    return best.vertex == kNoIndex ? std::nullopt : std::optional(best);
  }

  const Graph& graph_;
  std::vector<LocalIndex> part_;
  std::vector<std::int64_t> weight_;  ///< Shape (num_parts).
  std::vector<LocalIndex> size_;      ///< Shape (num_parts); vertices.
};

}  // namespace

std::vector<LocalIndex> balanced_parts(const Graph& graph, LocalIndex num_parts,
                                       const GraphPartitioner& partitioner)
{
  Parts parts(graph, num_parts, checked_partition(partitioner, graph, num_parts));
  parts.connect();
  parts.balance();
  return std::move(parts).take();
}

}  // namespace tessera::decompose
