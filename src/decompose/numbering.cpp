// SPDX-License-Identifier: BSD-3-Clause
#include "decompose/numbering.hpp"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <span>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "tessera/base/error.hpp"

#include "decompose/partition/checked_partition.hpp"
#include "decompose/parts.hpp"

namespace tessera::decompose {
namespace {

struct Numbering {
  std::vector<LocalIndex> number{};        // Shape (num_subdomains).
  std::vector<LocalIndex> part_offsets{};  // As in mesh::Decomposition.
};

// One triangle between two subdomains, seen from the first.
struct Contact {
  LocalIndex from;
  LocalIndex to;
  double area;
};

// Sorted by (from, to); equal ones in the order of the triangles, so that both directions add up
// the same areas in the same order.
std::vector<Contact> find_contacts(const TetGraph& graph, std::span<const LocalIndex> tet_subdomain)
{
  std::vector<Contact> contacts;
  for (const mesh::TriangleTets& triangle : graph.triangles) {
    if (triangle.tets[1] == kNoIndex) continue;
    const LocalIndex a = tet_subdomain[static_cast<std::size_t>(triangle.tets[0])];
    const LocalIndex b = tet_subdomain[static_cast<std::size_t>(triangle.tets[1])];
    if (a == b) continue;
    const double area = triangle_area(*graph.mesh, triangle);
    contacts.push_back({a, b, area});
    contacts.push_back({b, a, area});
  }
  std::stable_sort(contacts.begin(), contacts.end(), [](const Contact& a, const Contact& b) {
    return a.from != b.from ? a.from < b.from : a.to < b.to;
  });
  return contacts;
}

class HierarchicalOrder {
 public:
  HierarchicalOrder(const mesh::Decomposition& decomposition, std::vector<Vec3> place,
                    const GraphPartitioner& partitioner)
      : decomposition_(&decomposition),
        partitioner_(&partitioner),
        place_(std::move(place)),
        weight_(quantise(decomposition.subdomain_weight)),
        area_(decomposition.neighbour_area.empty() ? std::vector<std::int32_t>{}
                                                   : quantise(decomposition.neighbour_area)),
        order_(weight_.size()),
        block_begin_(weight_.size(), 0),
        local_(weight_.size(), kNoIndex)
  {
    std::iota(order_.begin(), order_.end(), 0);
  }

  // Numbers from 0 in the final order.
  Numbering run(LocalIndex num_parts)
  {
    Numbering result;
    std::vector<Block> blocks{{0, order_.size()}};
    if (num_parts > 0) {
      result.part_offsets = sort_by_part(num_parts);
      blocks.clear();
      for (std::size_t p = result.part_offsets.size() - 1; p > 0; --p) {
        blocks.push_back({static_cast<std::size_t>(result.part_offsets[p - 1]),
                          static_cast<std::size_t>(result.part_offsets[p])});
      }
    }
    while (!blocks.empty()) {
      const Block block = blocks.back();
      blocks.pop_back();
      if (block.end - block.begin < 2) continue;
      const std::size_t middle = bisect(block);
      blocks.push_back({middle, block.end});
      blocks.push_back({block.begin, middle});
    }
    result.number.resize(order_.size());
    for (std::size_t i = 0; i < order_.size(); ++i) {
      result.number[static_cast<std::size_t>(order_[i])] = static_cast<LocalIndex>(i);
    }
    return result;
  }

 private:
  // order_[begin, end): subdomains whose numbers are these, in an order not yet known.
  struct Block {
    std::size_t begin;
    std::size_t end;
  };

  // Where each part begins in the order.
  std::vector<LocalIndex> sort_by_part(LocalIndex num_parts)
  {
    const auto part = balanced_parts(graph_of(order_), num_parts, *partitioner_);
    std::ranges::stable_sort(order_, {}, [&](LocalIndex s) { return part[at(s)]; });
    std::vector<LocalIndex> offsets(at(num_parts) + 1, 0);
    for (const LocalIndex p : part) ++offsets[at(p) + 1];
    std::partial_sum(offsets.begin(), offsets.end(), offsets.begin());
    for (const LocalIndex s : order_) {
      block_begin_[at(s)] = static_cast<std::size_t>(offsets[at(part[at(s)])]);
    }
    return offsets;
  }

  std::size_t bisect(const Block& block)
  {
    const auto members = std::span(order_).subspan(block.begin, block.end - block.begin);
    const auto part = checked_partition(*partitioner_, graph_of(members), 2);
    std::vector<LocalIndex> halves[2];
    for (std::size_t i = 0; i < members.size(); ++i) {
      halves[static_cast<std::size_t>(part[i])].push_back(members[i]);
    }
    if (halves[0].empty() || halves[1].empty()) {
      const auto cut = members.begin() + static_cast<std::ptrdiff_t>(members.size() / 2);
      halves[0].assign(members.begin(), cut);
      halves[1].assign(cut, members.end());
    }
    const auto first_pull = pull_forwards(halves[0], block);
    const auto second_pull = pull_forwards(halves[1], block);
    const bool swap = first_pull != second_pull ? first_pull < second_pull
                                                : halves[1].front() < halves[0].front();
    if (swap) std::swap(halves[0], halves[1]);
    const auto middle = std::copy(halves[0].begin(), halves[0].end(), members.begin());
    std::copy(halves[1].begin(), halves[1].end(), middle);
    for (const LocalIndex s : halves[1]) {
      block_begin_[static_cast<std::size_t>(s)] = block.begin + halves[0].size();
    }
    return block.begin + halves[0].size();
  }

  // Contact with what comes before the block minus contact with what comes after it.
  [[nodiscard]] std::int64_t pull_forwards(std::span<const LocalIndex> half,
                                           const Block& block) const
  {
    std::int64_t pull = 0;
    for_each_neighbour(half, [&](LocalIndex, LocalIndex neighbour, std::int32_t area) {
      const std::size_t at = block_begin_[static_cast<std::size_t>(neighbour)];
      if (at < block.begin) pull += area;
      if (at >= block.end) pull -= area;
    });
    return pull;
  }

  Graph graph_of(std::span<const LocalIndex> members)
  {
    Graph graph;
    graph.offsets.assign(members.size() + 1, 0);
    LocalIndex next = 0;
    for (const LocalIndex s : members) {
      local_[static_cast<std::size_t>(s)] = next++;
      graph.vertex_weight.push_back(weight_[static_cast<std::size_t>(s)]);
      if (!place_.empty()) graph.place.push_back(place_[at(s)]);
    }
    for_each_neighbour(members, [&](LocalIndex s, LocalIndex neighbour, std::int32_t area) {
      const LocalIndex local = local_[static_cast<std::size_t>(neighbour)];
      if (local == kNoIndex) return;
      graph.neighbours.push_back(local);
      graph.edge_weight.push_back(area);
      ++graph.offsets[static_cast<std::size_t>(local_[static_cast<std::size_t>(s)]) + 1];
    });
    std::partial_sum(graph.offsets.begin(), graph.offsets.end(), graph.offsets.begin());
    for (const LocalIndex s : members) local_[static_cast<std::size_t>(s)] = kNoIndex;
    return graph;
  }

  template <class Visit>
  void for_each_neighbour(std::span<const LocalIndex> members, const Visit& visit) const
  {
    for (const LocalIndex s : members) {
      const auto at = static_cast<std::size_t>(s);
      const auto last = static_cast<std::size_t>(decomposition_->neighbour_offsets[at + 1]);
      for (auto i = static_cast<std::size_t>(decomposition_->neighbour_offsets[at]); i < last;
           ++i) {
        visit(s, decomposition_->neighbours[i], area_[i]);
      }
    }
  }

  const mesh::Decomposition* decomposition_;
  const GraphPartitioner* partitioner_;
  std::vector<Vec3> place_;  // Of each subdomain, if the partitioner needs them.
  std::vector<std::int32_t> weight_;
  std::vector<std::int32_t> area_;
  std::vector<LocalIndex> order_;
  std::vector<std::size_t> block_begin_;  // shape (num_subdomains): first number of its block
  std::vector<LocalIndex> local_;         // shape (num_subdomains); kNoIndex between calls
};

// Centroids of their tets, by weight.
std::vector<Vec3> places_of_subdomains(const TetGraph& graph,
                                       const mesh::Decomposition& decomposition)
{
  std::vector<Vec3> places(decomposition.subdomain_weight.size(), Vec3{});
  for (LocalIndex t = 0; t < graph.num_tets(); ++t) {
    const std::size_t s = at(decomposition.tet_subdomain[at(t)]);
    const double share = graph.weight(t) / decomposition.subdomain_weight[s];
    places[s] = places[s] + share * centroid_of(*graph.mesh, t);
  }
  return places;
}

// New number of each subdomain, by recursive bisection of the weighted graph. Of two halves the one
// nearer to what is already numbered comes first. So every aligned range is a connected, cheaply
// cut part wherever the partitioner finds one.
Numbering hierarchical_numbers(const TetGraph& graph, const mesh::Decomposition& decomposition,
                               LocalIndex num_parts, const GraphPartitioner& partitioner)
{
  std::vector<Vec3> places;
  if (partitioner.needs_places()) places = places_of_subdomains(graph, decomposition);
  return HierarchicalOrder(decomposition, std::move(places), partitioner).run(num_parts);
}

}  // namespace

mesh::Decomposition make_decomposition(const TetGraph& graph, FlatArray<LocalIndex> tet_subdomain)
{
  mesh::Decomposition result;
  for (LocalIndex t = 0; t < graph.num_tets(); ++t) {
    const auto s = static_cast<std::size_t>(tet_subdomain[static_cast<std::size_t>(t)]);
    if (s >= result.subdomain_weight.size()) {
      result.subdomain_weight.resize(s + 1, 0.0);
      result.subdomain_material.resize(s + 1, 0);
    }
    result.subdomain_weight[s] += graph.weight(t);
    result.subdomain_material[s] = graph.mesh->tet_material[static_cast<std::size_t>(t)];
  }
  result.neighbour_offsets.assign(result.subdomain_weight.size() + 1, 0);
  const Contact* previous = nullptr;
  const std::vector<Contact> contacts = find_contacts(graph, tet_subdomain);
  for (const Contact& contact : contacts) {
    const bool is_new =
        previous == nullptr || previous->from != contact.from || previous->to != contact.to;
    if (is_new) {
      ++result.neighbour_offsets[static_cast<std::size_t>(contact.from) + 1];
      result.neighbours.push_back(contact.to);
      result.neighbour_triangles.push_back(0);
      result.neighbour_area.push_back(0.0);
    }
    ++result.neighbour_triangles.back();
    result.neighbour_area.back() += contact.area;
    previous = &contact;
  }
  auto& offsets = result.neighbour_offsets;
  std::partial_sum(offsets.begin(), offsets.end(), offsets.begin());
  result.tet_subdomain = std::move(tet_subdomain);
  return result;
}

mesh::Decomposition number_subdomains(const TetGraph& graph, const TetPartition& partition,
                                      LocalIndex num_parts, const GraphPartitioner& partitioner)
{
  std::vector<LocalIndex> compact(static_cast<std::size_t>(partition.num_parts()), kNoIndex);
  std::vector<LocalIndex> tet_subdomain(static_cast<std::size_t>(graph.num_tets()));
  LocalIndex next = 0;
  for (LocalIndex t = 0; t < graph.num_tets(); ++t) {
    LocalIndex& number = compact[static_cast<std::size_t>(partition.of(t))];
    if (number == kNoIndex) number = next++;
    tet_subdomain[static_cast<std::size_t>(t)] = number;
  }
  mesh::Decomposition provisional = make_decomposition(graph, std::move(tet_subdomain));
  if (provisional.num_subdomains() < num_parts) {
    throw ConfigError(
        fmt::format("output.parts is {} but there are only {} subdomains; ask for more of them "
                    "(decompose.subdomains)",
                    num_parts, provisional.num_subdomains()));
  }
  Numbering numbering = hierarchical_numbers(graph, provisional, num_parts, partitioner);
  for (LocalIndex& s : provisional.tet_subdomain) s = numbering.number[static_cast<std::size_t>(s)];
  mesh::Decomposition numbered = make_decomposition(graph, std::move(provisional.tet_subdomain));
  numbered.part_offsets = std::move(numbering.part_offsets);
  return numbered;
}

}  // namespace tessera::decompose
