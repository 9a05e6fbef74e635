// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/mesh/edge_levels.hpp"

#include <algorithm>
#include <utility>

#include "tessera/base/error.hpp"
#include "tessera/mesh/lattice.hpp"

namespace tessera::mesh {

EdgeLevels::EdgeLevels(const std::vector<LocalIndex>& edge_vertices, FlatArray<std::int8_t> levels)
    : levels_(std::move(levels))
{
  if (levels_.empty()) return;
  for (std::size_t edge = 0; edge < levels_.size(); ++edge) {
    first_edge_.resize(at(edge_vertices[2 * edge]) + 1, static_cast<LocalIndex>(edge));
    upper_vertex_.push_back(edge_vertices[2 * edge + 1]);
  }
  first_edge_.push_back(static_cast<LocalIndex>(levels_.size()));
  find_largest();
}

void EdgeLevels::find_largest()
{
  const auto [least, most] = std::ranges::minmax(levels_);
  if (least == most)
    *this = EdgeLevels(most);
  else
    largest_ = most;
}

int EdgeLevels::of(LocalIndex a, LocalIndex b) const
{
  if (is_uniform()) return largest_;
  const auto [lower, upper] = std::minmax(a, b);
  const auto edges = upper_vertex_.begin();
  const auto found =
      std::find(edges + first_edge_[at(lower)], edges + first_edge_[at(lower) + 1], upper);
  return levels_[static_cast<std::size_t>(found - edges)];
}

template <class Change>
EdgeLevels EdgeLevels::changed(Change&& change) const
{
  if (is_uniform()) return change(largest_);
  EdgeLevels result = *this;
  for (std::int8_t& level : result.levels_) level = static_cast<std::int8_t>(change(level));
  result.find_largest();
  return result;
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
  const bool has_lists = first_edge_.empty()
                             ? levels_.empty()
                             : first_edge_.front() == 0 && std::ranges::is_sorted(first_edge_)
                                   && at(first_edge_.back()) == levels_.size();
  if (!has_lists || upper_vertex_.size() != levels_.size()) {
    throw InputError("levels of edges: arrays of different lengths");
  }
  for (std::size_t lower = 0; lower + 1 < first_edge_.size(); ++lower) {
    LocalIndex before = static_cast<LocalIndex>(lower);
    for (LocalIndex edge = first_edge_[lower]; edge < first_edge_[lower + 1]; ++edge) {
      if (upper_vertex_[at(edge)] <= before) {
        throw InputError("levels of edges: edges do not ascend");
      }
      before = upper_vertex_[at(edge)];
    }
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
