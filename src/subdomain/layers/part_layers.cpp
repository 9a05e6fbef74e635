// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/subdomain/part_layers.hpp"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <string_view>

namespace tessera::subdomain {

std::vector<LocalIndex> columns_of_layers(const migrate::MeshBlock& block,
                                          std::span<const migrate::TetColumn> columns)
{
  const auto values_of = [&](std::string_view name) -> std::span<const std::uint64_t> {
    const auto found = std::ranges::find(columns, name, &migrate::TetColumn::name);
    if (found == columns.end()) return {};
    return block.tet_columns[static_cast<std::size_t>(found - columns.begin())];
  };
  const auto layer = values_of("layer");
  const auto of_prism = values_of("tet_of_prism");
  std::vector<LocalIndex> first(at(block.num_tets()));
  std::iota(first.begin(), first.end(), 0);
  if (layer.empty() || of_prism.empty()) return first;
  // A column goes from its last layer, beside the tets inside, to the first one, at the wall.
  for (std::size_t t = 1; t < first.size(); ++t) {
    const bool are_neighbours = block.tet_ids[t] == block.tet_ids[t - 1] + 1 && layer[t] > 0;
    if (are_neighbours && (of_prism[t] > 0 || layer[t] < layer[t - 1])) first[t] = first[t - 1];
  }
  return first;
}

}  // namespace tessera::subdomain
