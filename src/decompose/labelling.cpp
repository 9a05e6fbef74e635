// SPDX-License-Identifier: BSD-3-Clause
#include "decompose/labelling.hpp"

#include <numeric>
#include <utility>

namespace tessera::decompose {

Labelling::Labelling(const TetGraph& graph, std::vector<LocalIndex> tet_label,
                     LocalIndex num_labels)
    : graph_(&graph),
      tet_label_(std::move(tet_label)),
      weight_(static_cast<std::size_t>(num_labels), 0.0),
      num_tets_(static_cast<std::size_t>(num_labels), 0)
{
  for (LocalIndex t = 0; t < graph.num_tets(); ++t) {
    const auto label = static_cast<std::size_t>(of(t));
    weight_[label] += graph.weight(t);
    total_weight_ += graph.weight(t);
    if (num_tets_[label]++ == 0) ++num_used_;
  }
}

void Labelling::assign(LocalIndex t, LocalIndex label)
{
  const auto from = static_cast<std::size_t>(of(t));
  const auto to = static_cast<std::size_t>(label);
  weight_[from] -= graph_->weight(t);
  weight_[to] += graph_->weight(t);
  if (--num_tets_[from] == 0) --num_used_;
  if (num_tets_[to]++ == 0) ++num_used_;
  tet_label_[static_cast<std::size_t>(t)] = label;
}

LocalIndex Labelling::add_label()
{
  weight_.push_back(0.0);
  num_tets_.push_back(0);
  return num_labels() - 1;
}

LabelTets tets_of_labels(const TetGraph& graph, const Labelling& labelling)
{
  LabelTets result;
  result.offsets.assign(static_cast<std::size_t>(labelling.num_labels()) + 1, 0);
  for (LocalIndex t = 0; t < graph.num_tets(); ++t) {
    ++result.offsets[static_cast<std::size_t>(labelling.of(t)) + 1];
  }
  std::partial_sum(result.offsets.begin(), result.offsets.end(), result.offsets.begin());
  result.tets.resize(static_cast<std::size_t>(graph.num_tets()));
  std::vector<LocalIndex> next(result.offsets.begin(), result.offsets.end() - 1);
  for (LocalIndex t = 0; t < graph.num_tets(); ++t) {
    const LocalIndex slot = next[static_cast<std::size_t>(labelling.of(t))]++;
    result.tets[static_cast<std::size_t>(slot)] = t;
  }
  return result;
}

}  // namespace tessera::decompose
