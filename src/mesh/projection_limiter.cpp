// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/mesh/projection_limiter.hpp"

#include <algorithm>
#include <utility>

#include "tessera/base/error.hpp"

namespace tessera::mesh {

ProjectionLimiter::ProjectionLimiter(std::vector<PointLimit> entries) : entries_(std::move(entries))
{
  std::sort(entries_.begin(), entries_.end(), [](const PointLimit& a, const PointLimit& b) {
    return a.key != b.key ? a.key < b.key : a.factor < b.factor;
  });
  const auto same_key = [](const PointLimit& a, const PointLimit& b) { return a.key == b.key; };
  entries_.erase(std::unique(entries_.begin(), entries_.end(), same_key), entries_.end());
}

double ProjectionLimiter::factor(const LatticePointKey& key) const
{
  if (entries_.empty()) return 1.0;
  const auto place = std::lower_bound(
      entries_.begin(), entries_.end(), key,
      [](const PointLimit& a, const LatticePointKey& wanted) { return a.key < wanted; });
  return place != entries_.end() && place->key == key ? place->factor : 1.0;
}

void ProjectionLimiter::require_sound() const
{
  const auto is_out_of_order = [](const PointLimit& a, const PointLimit& b) {
    return a.key >= b.key;
  };
  const bool ascends = std::ranges::adjacent_find(entries_, is_out_of_order) == entries_.end();
  const bool has_factors = std::ranges::all_of(
      entries_, [](const PointLimit& entry) { return 0.0 <= entry.factor && entry.factor <= 1.0; });
  if (!ascends || !has_factors) throw InputError("record of a limiter is damaged");
}

}  // namespace tessera::mesh
