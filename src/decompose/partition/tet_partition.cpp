// SPDX-License-Identifier: BSD-3-Clause
#include "decompose/partition/tet_partition.hpp"

#include <utility>

namespace tessera::decompose {

TetPartition::TetPartition(const TetGraph& graph, std::vector<LocalIndex> tet_part,
                           LocalIndex num_parts)
    : graph_(&graph),
      tet_part_(std::move(tet_part)),
      weight_(static_cast<std::size_t>(num_parts), 0.0),
      num_tets_(static_cast<std::size_t>(num_parts), 0)
{
  for (LocalIndex t = 0; t < graph.num_tets(); ++t) {
    const auto part = static_cast<std::size_t>(of(t));
    weight_[part] += graph.weight(t);
    total_weight_ += graph.weight(t);
    if (num_tets_[part]++ == 0) ++num_used_;
  }
}

void TetPartition::assign(LocalIndex t, LocalIndex part)
{
  const auto from = static_cast<std::size_t>(of(t));
  const auto to = static_cast<std::size_t>(part);
  weight_[from] -= graph_->weight(t);
  weight_[to] += graph_->weight(t);
  if (--num_tets_[from] == 0) --num_used_;
  if (num_tets_[to]++ == 0) ++num_used_;
  tet_part_[static_cast<std::size_t>(t)] = part;
}

LocalIndex TetPartition::add_part()
{
  weight_.push_back(0.0);
  num_tets_.push_back(0);
  return num_parts() - 1;
}

IndexLists tets_of_parts(const TetPartition& partition)
{
  return rows_by_key(partition.tet_part(), partition.num_parts());
}

}  // namespace tessera::decompose
