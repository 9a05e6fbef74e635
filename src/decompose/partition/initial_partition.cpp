// SPDX-License-Identifier: BSD-3-Clause
#include "decompose/partition/initial_partition.hpp"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <queue>
#include <utility>

#include "decompose/partition/checked_partition.hpp"
#include "decompose/repair/regions.hpp"
#include "decompose/repair/slivers.hpp"

namespace tessera::decompose {
namespace {

double weight_of(const TetGraph& graph, std::span<const LocalIndex> tets)
{
  double weight = 0.0;
  for (const LocalIndex t : tets) weight += graph.weight(t);
  return weight;
}

std::vector<Vec3> centroids_of(const mesh::CoarseMesh& mesh, std::span<const LocalIndex> tets)
{
  std::vector<Vec3> centroids;
  centroids.reserve(tets.size());
  for (const LocalIndex t : tets) centroids.push_back(centroid_of(mesh, t));
  return centroids;
}

std::vector<LocalIndex> parts_of_pieces(const TetGraph& graph,
                                        const std::vector<std::vector<LocalIndex>>& pieces,
                                        const std::vector<LocalIndex>& num_parts,
                                        const GraphPartitioner& partitioner)
{
  std::vector<LocalIndex> tet_part(static_cast<std::size_t>(graph.num_tets()), kNoIndex);
  std::vector<LocalIndex> local_index(tet_part.size(), kNoIndex);
  LocalIndex first_part = 0;
  for (std::size_t p = 0; p < pieces.size(); ++p) {
    Graph dual = dual_graph(graph, pieces[p], local_index);
    if (partitioner.needs_places()) dual.place = centroids_of(*graph.mesh, pieces[p]);
    const auto part = checked_partition(partitioner, dual, num_parts[p]);
    for (std::size_t i = 0; i < pieces[p].size(); ++i) {
      tet_part[static_cast<std::size_t>(pieces[p][i])] = first_part + part[i];
    }
    first_part += num_parts[p];
  }
  return tet_part;
}

// Halves the heaviest part until there are `num_wanted`. Partitioners leave parts empty when there
// are nearly as many parts as tets.
void raise_number(const TetGraph& graph, TetPartition& partition, LocalIndex num_wanted)
{
  if (partition.num_used() >= num_wanted) return;
  struct Candidate {
    double weight;
    std::vector<LocalIndex> tets;
    bool operator<(const Candidate& other) const
    {
      return weight != other.weight ? weight < other.weight : tets.front() > other.tets.front();
    }
  };
  std::priority_queue<Candidate> heaviest;
  const auto offer = [&](std::span<const LocalIndex> tets) {
    if (tets.size() > 1) heaviest.push({weight_of(graph, tets), {tets.begin(), tets.end()}});
  };
  const IndexLists part_tets = tets_of_parts(partition);
  for (LocalIndex part = 0; part < partition.num_parts(); ++part) offer(part_tets[part]);

  RegionSearch search(graph);
  while (partition.num_used() < num_wanted) {
    const std::vector<LocalIndex> tets = heaviest.top().tets;
    heaviest.pop();
    const auto second = search.halve(tets);
    const LocalIndex old_part = partition.of(tets.front());
    const LocalIndex new_part = partition.add_part();
    for (const LocalIndex t : second) partition.assign(t, new_part);
    std::vector<LocalIndex> first;
    for (const LocalIndex t : tets) {
      if (partition.of(t) == old_part) first.push_back(t);
    }
    offer(first);
    offer(second);
  }
}

}  // namespace

std::vector<std::vector<LocalIndex>> connected_pieces(const TetGraph& graph,
                                                      std::span<const LocalIndex> tet_part)
{
  std::vector<LocalIndex> one_part;
  if (tet_part.empty()) {
    one_part.assign(static_cast<std::size_t>(graph.num_tets()), 0);
    tet_part = one_part;
  }
  const LocalIndex num_parts = 1 + *std::max_element(tet_part.begin(), tet_part.end());
  const IndexLists part_tets = rows_by_key(tet_part, num_parts);
  RegionSearch search(graph);
  std::vector<std::vector<LocalIndex>> pieces;
  for (LocalIndex part = 0; part < num_parts; ++part) {
    for (auto& piece : search.components(part_tets[part])) pieces.push_back(std::move(piece));
  }
  for (auto& piece : pieces) std::sort(piece.begin(), piece.end());
  std::sort(pieces.begin(), pieces.end());
  return pieces;
}

std::vector<LocalIndex> allot_parts(const TetGraph& graph,
                                    const std::vector<std::vector<LocalIndex>>& pieces,
                                    LocalIndex num_parts)
{
  using Share = std::pair<double, std::size_t>;  // mean weight of the parts so far; minus the piece
  std::vector<LocalIndex> allotted(pieces.size(), 1);
  std::vector<double> weight(pieces.size());
  std::priority_queue<Share> heaviest;
  const auto offer = [&](std::size_t p) {
    const bool is_full = static_cast<std::size_t>(allotted[p]) == pieces[p].size();
    if (!is_full) heaviest.emplace(weight[p] / allotted[p], pieces.size() - p);
  };
  for (std::size_t p = 0; p < pieces.size(); ++p) {
    weight[p] = weight_of(graph, pieces[p]);
    offer(p);
  }
  for (auto left = static_cast<std::size_t>(num_parts) - pieces.size(); left > 0; --left) {
    const std::size_t p = pieces.size() - heaviest.top().second;
    heaviest.pop();
    ++allotted[p];
    offer(p);
  }
  return allotted;
}

TetPartition partition_pieces(const TetGraph& graph,
                              const std::vector<std::vector<LocalIndex>>& pieces,
                              LocalIndex num_parts, const GraphPartitioner& partitioner)
{
  const auto allotted = allot_parts(graph, pieces, num_parts);
  const auto tet_part = parts_of_pieces(graph, pieces, allotted, partitioner);
  TetPartition partition = connect_parts(graph, tet_part, num_parts);
  raise_number(graph, partition, num_parts);
  return partition;
}

}  // namespace tessera::decompose
