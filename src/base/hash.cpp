// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/base/hash.hpp"

#include <cstring>

#include <fmt/format.h>

#define XXH_INLINE_ALL  // A tet is 136 bytes: knowing the length pays.
#include <xxhash.h>

namespace tessera {

Hash128 hash_bytes(std::span<const std::byte> bytes) noexcept
{
  const XXH128_hash_t hash = XXH3_128bits(bytes.data(), bytes.size());
  return {hash.low64, hash.high64};
}

Hash128 hash_tet(std::span<const GlobalIndex, 4> vertex_ids, std::span<const double, 12> xyz,
                 std::int32_t material) noexcept
{
  struct Record {
    GlobalIndex vertex_ids[4];
    double xyz[12];
    std::int64_t material;
  } record;
  static_assert(sizeof(Record) == 136, "padding would leave bytes that are not set");
  std::memcpy(record.vertex_ids, vertex_ids.data(), sizeof(record.vertex_ids));
  std::memcpy(record.xyz, xyz.data(), sizeof(record.xyz));
  record.material = material;
  return hash_bytes(std::as_bytes(std::span(&record, 1)));
}

std::string to_hex(const Hash128& hash)
{
  return fmt::format("{:016x}{:016x}", hash.high, hash.low);
}

}  // namespace tessera
