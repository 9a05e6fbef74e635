// SPDX-License-Identifier: BSD-3-Clause
#include "decompose/repair/regions.hpp"

#include <array>
#include <cstddef>

namespace tessera::decompose {

RegionSearch::RegionSearch(const TetGraph& graph)
    : graph_(&graph), mark_(static_cast<std::size_t>(graph.num_tets()), Mark::outside)
{
}

void RegionSearch::mark(std::span<const LocalIndex> tets, Mark value)
{
  for (const LocalIndex t : tets) mark_[static_cast<std::size_t>(t)] = value;
}

void RegionSearch::flood(LocalIndex start, std::vector<LocalIndex>& reached)
{
  reached.assign(1, start);
  mark_[static_cast<std::size_t>(start)] = Mark::reached;
  for (std::size_t head = 0; head < reached.size(); ++head) {
    for (const LocalIndex neighbour : graph_->neighbours(reached[head])) {
      if (neighbour == kNoIndex) continue;
      Mark& state = mark_[static_cast<std::size_t>(neighbour)];
      if (state != Mark::inside) continue;
      state = Mark::reached;
      reached.push_back(neighbour);
    }
  }
}

std::vector<std::vector<LocalIndex>> RegionSearch::components(std::span<const LocalIndex> tets)
{
  std::vector<std::vector<LocalIndex>> result;
  mark(tets, Mark::inside);
  for (const LocalIndex t : tets) {
    if (mark_[static_cast<std::size_t>(t)] == Mark::inside) flood(t, result.emplace_back());
  }
  mark(tets, Mark::outside);
  return result;
}

std::vector<LocalIndex> RegionSearch::reach(std::span<const LocalIndex> tets, LocalIndex start)
{
  std::vector<LocalIndex> reached;
  mark(tets, Mark::inside);
  flood(start, reached);
  mark(tets, Mark::outside);
  return reached;
}

std::vector<LocalIndex> RegionSearch::cut(std::span<const LocalIndex> tets,
                                          std::span<const LocalIndex> first_seed,
                                          std::span<const LocalIndex> second_seed)
{
  struct Side {
    std::vector<LocalIndex> tets{};
    std::size_t head = 0;
    double weight = 0.0;
    [[nodiscard]] bool is_done() const { return head == tets.size(); }
  };
  std::array<Side, 2> sides;
  const auto take = [&](Side& side, LocalIndex t) {
    mark_[static_cast<std::size_t>(t)] = Mark::reached;
    side.tets.push_back(t);
    side.weight += graph_->weight(t);
  };
  mark(tets, Mark::inside);
  for (const LocalIndex t : first_seed) take(sides[0], t);
  for (const LocalIndex t : second_seed) take(sides[1], t);
  while (!sides[0].is_done() || !sides[1].is_done()) {
    const bool second_is_lighter = sides[1].weight < sides[0].weight;
    const bool grow_second = sides[0].is_done() || (second_is_lighter && !sides[1].is_done());
    Side& side = sides[grow_second ? 1 : 0];
    for (const LocalIndex neighbour : graph_->neighbours(side.tets[side.head++])) {
      if (neighbour == kNoIndex) continue;
      if (mark_[static_cast<std::size_t>(neighbour)] == Mark::inside) take(side, neighbour);
    }
  }
  mark(tets, Mark::outside);
  return sides[1].tets;
}

std::vector<LocalIndex> RegionSearch::halve(std::span<const LocalIndex> tets)
{
  const LocalIndex first = reach(tets, tets.front()).back();
  const LocalIndex second = reach(tets, first).back();
  return cut(tets, std::span(&first, 1), std::span(&second, 1));
}

}  // namespace tessera::decompose
