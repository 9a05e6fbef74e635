// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/mesh/damping.hpp"

#include <algorithm>
#include <utility>

namespace tessera::mesh {

Damping::Damping(std::vector<PointDamping> entries) : entries_(std::move(entries))
{
  std::sort(entries_.begin(), entries_.end(), [](const PointDamping& a, const PointDamping& b) {
    return a.key != b.key ? a.key < b.key : a.factor < b.factor;
  });
  const auto same_key = [](const PointDamping& a, const PointDamping& b) { return a.key == b.key; };
  entries_.erase(std::unique(entries_.begin(), entries_.end(), same_key), entries_.end());
}

double Damping::factor(const LatticePointKey& key) const
{
  if (entries_.empty()) return 1.0;
  const auto place = std::lower_bound(
      entries_.begin(), entries_.end(), key,
      [](const PointDamping& a, const LatticePointKey& wanted) { return a.key < wanted; });
  return place != entries_.end() && place->key == key ? place->factor : 1.0;
}

// Keys and factors apart: PointDamping has padding, whose bytes nobody sets.
Bytes to_bytes(const Damping& damping)
{
  std::vector<LatticePointKey> keys;
  std::vector<double> factors;
  for (const PointDamping& entry : damping.entries()) {
    keys.push_back(entry.key);
    factors.push_back(entry.factor);
  }
  ByteWriter out;
  out.put(keys);
  out.put(factors);
  return std::move(out).take();
}

Damping damping_from_bytes(std::span<const std::byte> bytes)
{
  ByteReader in(bytes);
  const auto keys = in.get_vector<LatticePointKey>();
  const auto factors = in.get_vector<double>();
  if (keys.size() != factors.size()) throw InputError("record of a damping is inconsistent");
  std::vector<PointDamping> entries;
  for (std::size_t i = 0; i < keys.size(); ++i) entries.push_back({keys[i], factors[i]});
  return Damping(std::move(entries));
}

}  // namespace tessera::mesh
