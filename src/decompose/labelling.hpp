// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "decompose/tet_graph.hpp"

namespace tessera::decompose {

/// @brief A decomposition in the making: the label of each tet, and sums by label. Labels may be
/// empty; the final numbering drops those.
class Labelling {
 public:
  /// @param[in] tet_label Shape (num_tets), in [0, num_labels).
  Labelling(const TetGraph& graph, std::vector<LocalIndex> tet_label, LocalIndex num_labels);

  [[nodiscard]] LocalIndex of(LocalIndex t) const
  {
    return tet_label_[static_cast<std::size_t>(t)];
  }
  [[nodiscard]] LocalIndex num_labels() const { return static_cast<LocalIndex>(weight_.size()); }
  [[nodiscard]] LocalIndex num_used() const { return num_used_; }
  [[nodiscard]] double weight(LocalIndex label) const
  {
    return weight_[static_cast<std::size_t>(label)];
  }
  [[nodiscard]] LocalIndex num_tets(LocalIndex label) const
  {
    return num_tets_[static_cast<std::size_t>(label)];
  }
  [[nodiscard]] double mean_weight() const { return total_weight_ / num_used_; }

  /// @brief Gives tet `t` to another label.
  void assign(LocalIndex t, LocalIndex label);
  /// @brief A label that no tet has.
  [[nodiscard]] LocalIndex add_label();

  /// @brief Sets and resets the label of `t` for a what-if question; sums are not touched.
  void pretend(LocalIndex t, LocalIndex label) { tet_label_[static_cast<std::size_t>(t)] = label; }

 private:
  const TetGraph* graph_;
  std::vector<LocalIndex> tet_label_;
  std::vector<double> weight_;
  std::vector<LocalIndex> num_tets_;
  double total_weight_ = 0.0;
  LocalIndex num_used_ = 0;
};

/// @brief The tets of every label in CSR form, ascending.
struct LabelTets {
  std::vector<LocalIndex> offsets{};
  std::vector<LocalIndex> tets{};

  [[nodiscard]] std::span<const LocalIndex> of(LocalIndex label) const
  {
    const auto first = static_cast<std::size_t>(offsets[static_cast<std::size_t>(label)]);
    const auto last = static_cast<std::size_t>(offsets[static_cast<std::size_t>(label) + 1]);
    return std::span(tets).subspan(first, last - first);
  }
};
[[nodiscard]] LabelTets tets_of_labels(const TetGraph& graph, const Labelling& labelling);

}  // namespace tessera::decompose
