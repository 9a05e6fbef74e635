// SPDX-License-Identifier: BSD-3-Clause
#include "decompose/repair/slivers.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "tessera/base/union_find.hpp"

namespace tessera::decompose {
namespace {

// A component of a part lighter than this share of the mean part is a sliver: a subdomain of its
// own would be all seam.
constexpr double kSliverShare = 0.25;

struct Components {
  std::vector<LocalIndex> tet_component{};  // shape (num_tets)
  std::vector<double> weight{};             // shape (num_components)
  std::vector<bool> is_main{};              // the heaviest of its part
};

// Numbers the face-connected components of equal `tet_part`.
Components find_components(const TetGraph& graph, const std::vector<LocalIndex>& tet_part,
                           LocalIndex num_parts)
{
  Components result;
  result.tet_component.assign(tet_part.size(), kNoIndex);
  std::vector<LocalIndex> main_of_part(static_cast<std::size_t>(num_parts), kNoIndex);
  std::vector<LocalIndex> queue;
  for (LocalIndex seed = 0; seed < graph.num_tets(); ++seed) {
    if (result.tet_component[static_cast<std::size_t>(seed)] != kNoIndex) continue;
    const auto component = static_cast<LocalIndex>(result.weight.size());
    const LocalIndex part = tet_part[static_cast<std::size_t>(seed)];
    result.weight.push_back(0.0);
    queue.assign(1, seed);
    result.tet_component[static_cast<std::size_t>(seed)] = component;
    for (std::size_t head = 0; head < queue.size(); ++head) {
      result.weight.back() += graph.weight(queue[head]);
      for (const LocalIndex neighbour : graph.neighbours(queue[head])) {
        if (neighbour == kNoIndex || tet_part[static_cast<std::size_t>(neighbour)] != part)
          continue;
        LocalIndex& mark = result.tet_component[static_cast<std::size_t>(neighbour)];
        if (mark == kNoIndex) queue.push_back(neighbour);
        mark = component;
      }
    }
    LocalIndex& main = main_of_part[static_cast<std::size_t>(part)];
    const bool is_heavier =
        main == kNoIndex || result.weight.back() > result.weight[static_cast<std::size_t>(main)];
    if (is_heavier) main = component;
  }
  result.is_main.assign(result.weight.size(), false);
  for (const LocalIndex main : main_of_part) {
    if (main != kNoIndex) result.is_main[static_cast<std::size_t>(main)] = true;
  }
  return result;
}

struct Contact {
  LocalIndex from;
  LocalIndex to;
  std::int64_t price;
};

// For each sliver, the component it shares the most expensive seam with; kNoIndex if none, or if it
// is no sliver.
std::vector<LocalIndex> best_neighbours(const TetGraph& graph, const Components& components,
                                        const std::vector<bool>& is_sliver)
{
  std::vector<Contact> contacts;
  const auto component_of = [&](LocalIndex t) {
    return components.tet_component[static_cast<std::size_t>(t)];
  };
  for (LocalIndex t = 0; t < graph.num_tets(); ++t) {
    const LocalIndex from = component_of(t);
    if (!is_sliver[static_cast<std::size_t>(from)]) continue;
    for (std::size_t face = 0; face < 4; ++face) {
      const LocalIndex neighbour = graph.neighbours(t)[face];
      if (neighbour == kNoIndex || component_of(neighbour) == from) continue;
      contacts.push_back({from, component_of(neighbour), graph.face_cost(t)[face]});
    }
  }
  std::sort(contacts.begin(), contacts.end(), [](const Contact& a, const Contact& b) {
    return a.from != b.from ? a.from < b.from : a.to < b.to;
  });
  std::vector<LocalIndex> best(components.weight.size(), kNoIndex);
  std::vector<std::int64_t> best_price(best.size(), 0);
  for (std::size_t i = 0; i < contacts.size();) {
    const auto [from, to, first_price] = contacts[i];
    std::int64_t price = 0;
    for (; i < contacts.size() && contacts[i].from == from && contacts[i].to == to; ++i) {
      price += contacts[i].price;
    }
    const auto at = static_cast<std::size_t>(from);
    if (price <= best_price[at]) continue;
    best[at] = to;
    best_price[at] = price;
  }
  return best;
}

// Joins each sliver with its best neighbour and renumbers. Slivers point to one component each and
// main components to none, so no two main components can be joined.
bool join_slivers(const TetGraph& graph, Components& components, double limit)
{
  std::vector<bool> is_sliver(components.weight.size());
  for (std::size_t c = 0; c < is_sliver.size(); ++c) {
    is_sliver[c] = !components.is_main[c] && components.weight[c] < limit;
  }
  const auto target = best_neighbours(graph, components, is_sliver);
  UnionFind groups(static_cast<LocalIndex>(target.size()));
  bool any = false;
  for (std::size_t c = 0; c < target.size(); ++c) {
    if (target[c] == kNoIndex) continue;
    groups.join(static_cast<LocalIndex>(c), target[c]);
    any = true;
  }
  if (!any) return false;

  Components joined;
  std::vector<LocalIndex> new_number(target.size(), kNoIndex);
  for (std::size_t c = 0; c < target.size(); ++c) {
    // The lowest component of a group: it comes before the others.
    const auto root = static_cast<std::size_t>(groups.find(static_cast<LocalIndex>(c)));
    if (root == c) {
      new_number[c] = static_cast<LocalIndex>(joined.weight.size());
      joined.weight.push_back(0.0);
      joined.is_main.push_back(false);
    }
    const auto number = static_cast<std::size_t>(new_number[root]);
    joined.weight[number] += components.weight[c];
    if (components.is_main[c]) joined.is_main[number] = true;
    new_number[c] = new_number[root];
  }
  joined.tet_component = std::move(components.tet_component);
  for (LocalIndex& c : joined.tet_component) c = new_number[static_cast<std::size_t>(c)];
  components = std::move(joined);
  return true;
}

}  // namespace

TetPartition connect_parts(const TetGraph& graph, const std::vector<LocalIndex>& tet_part,
                           LocalIndex num_parts)
{
  Components components = find_components(graph, tet_part, num_parts);
  double total = 0.0;
  for (const double weight : components.weight) total += weight;
  const double limit = kSliverShare * total / num_parts;
  while (join_slivers(graph, components, limit)) {
  }
  const auto num_components = static_cast<LocalIndex>(components.weight.size());
  return TetPartition(graph, std::move(components.tet_component), num_components);
}

}  // namespace tessera::decompose
