// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <utility>
#include <vector>

#include "tessera/decompose/graph_partitioner.hpp"

namespace tessera::testing {

/// @brief Deals out any parts a test likes. The graph's vertices are the
/// tets of one connected piece of a material, ascending.
class FakePartitioner final : public decompose::GraphPartitioner {
 public:
  using Function = std::function<LocalIndex(LocalIndex vertex, LocalIndex num_parts)>;
  explicit FakePartitioner(Function part_of) : part_of_(std::move(part_of)) {}

  [[nodiscard]] std::vector<LocalIndex> partition(const decompose::Graph& graph,
                                                  LocalIndex num_parts) const override;

 private:
  Function part_of_;
};

/// @brief Parts that look random but depend on the arguments only.
[[nodiscard]] FakePartitioner random_partitioner(unsigned seed);

}  // namespace tessera::testing
