// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/mesh/edge_levels.hpp"

#include <algorithm>
#include <array>
#include <span>
#include <utility>

#include "tessera/base/error.hpp"
#include "tessera/mesh/lattice.hpp"
#include "tessera/mesh/sorted_rows.hpp"

namespace tessera::mesh {
namespace {

using Edge = std::array<LocalIndex, 2>;

Edge row_of(std::span<const LocalIndex> edge_vertices, std::size_t row)
{
  return {edge_vertices[2 * row], edge_vertices[2 * row + 1]};
}

}  // namespace

EdgeLevels::EdgeLevels(FlatArray<LocalIndex> edge_vertices, FlatArray<std::int8_t> levels)
    : edge_vertices_(std::move(edge_vertices)), levels_(std::move(levels))
{
  if (levels_.empty()) return;
  const auto [least, most] = std::ranges::minmax(levels_);
  largest_ = most;
  if (least < most) return;
  edge_vertices_.clear();
  levels_.clear();
}

int EdgeLevels::of(LocalIndex a, LocalIndex b) const
{
  if (is_uniform()) return largest_;
  return levels_[at(find_edge_row(edge_vertices_, a, b))];
}

template <class Change>
EdgeLevels EdgeLevels::changed(Change&& change) const
{
  if (is_uniform()) return change(largest_);
  FlatArray<std::int8_t> levels;
  levels.reserve(levels_.size());
  for (const std::int8_t level : levels_) levels.push_back(static_cast<std::int8_t>(change(level)));
  return {edge_vertices_, std::move(levels)};
}

EdgeLevels EdgeLevels::limited(int most) const
{
  if (most >= largest_) return *this;
  return changed([most](int level) { return std::min(level, most); });
}

EdgeLevels EdgeLevels::raised(int least) const
{
  return changed([least](int level) { return std::max(level, least); });
}

EdgeLevels EdgeLevels::shifted(int by) const
{
  return changed([by](int level) { return level + by; });
}

std::vector<GlobalIndex> EdgeLevels::histogram() const
{
  if (is_uniform()) return {};
  std::vector<GlobalIndex> counts(at(largest_) + 1, 0);
  for (const std::int8_t level : levels_) ++counts[at(level)];
  return counts;
}

void EdgeLevels::require_sound() const
{
  if (edge_vertices_.size() != 2 * levels_.size()) {
    throw InputError("levels of edges: arrays of different lengths");
  }
  Edge before{-1, -1};
  for (std::size_t row = 0; row < levels_.size(); ++row) {
    const Edge edge = row_of(edge_vertices_, row);
    if (edge[0] < 0 || edge[0] >= edge[1] || edge <= before) {
      throw InputError("levels of edges: edges do not ascend");
    }
    before = edge;
  }
  const auto is_level = [](int level) { return 0 <= level && level <= lattice::kMaxLevels; };
  if (!is_level(largest_) || !std::ranges::all_of(levels_, is_level)) {
    throw InputError("levels of edges: no such level");
  }
  if (levels_.empty()) return;
  const auto [least, most] = std::ranges::minmax(levels_);
  if (most != largest_ || least == most) {
    throw InputError("levels of edges: the largest is another");
  }
}

}  // namespace tessera::mesh
