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

Bytes to_bytes(const Damping& damping)
{
  ByteWriter out;
  out.put(std::vector<PointDamping>(damping.entries().begin(), damping.entries().end()));
  return std::move(out).take();
}

Damping damping_from_bytes(std::span<const std::byte> bytes)
{
  ByteReader in(bytes);
  return Damping(in.get_vector<PointDamping>());
}

}  // namespace tessera::mesh
