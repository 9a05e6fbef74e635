// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/mesh/projection_limiter.hpp"

#include <algorithm>
#include <utility>

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

// Keys and factors apart: PointLimit has padding, whose bytes nobody sets.
Bytes to_bytes(const ProjectionLimiter& limiter)
{
  std::vector<LatticePointKey> keys;
  std::vector<double> factors;
  for (const PointLimit& entry : limiter.entries()) {
    keys.push_back(entry.key);
    factors.push_back(entry.factor);
  }
  ByteWriter out;
  out.put(keys);
  out.put(factors);
  return std::move(out).take();
}

ProjectionLimiter projection_limiter_from_bytes(std::span<const std::byte> bytes)
{
  ByteReader in(bytes);
  const auto keys = in.get_vector<LatticePointKey>();
  const auto factors = in.get_vector<double>();
  if (keys.size() != factors.size()) throw InputError("record of a limiter is inconsistent");
  std::vector<PointLimit> entries;
  for (std::size_t i = 0; i < keys.size(); ++i) entries.push_back({keys[i], factors[i]});
  return ProjectionLimiter(std::move(entries));
}

}  // namespace tessera::mesh
