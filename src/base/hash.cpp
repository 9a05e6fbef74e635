// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/base/hash.hpp"

#include <array>
#include <cstring>

#include <fmt/format.h>

#define XXH_INLINE_ALL  // A tet is 136 bytes: knowing the length pays.
#include <xxhash.h>

namespace tessera {
namespace {

struct TetRecord {
  GlobalIndex vertex_ids[4]{};
  double xyz[12]{};
  std::int64_t material = 0;
};
static_assert(sizeof(TetRecord) == 136, "padding would leave bytes that are not set");

struct QuadraticTetRecord {
  GlobalIndex node_ids[10]{};
  double xyz[30]{};
  std::int64_t material = 0;
};
static_assert(sizeof(QuadraticTetRecord) == 328, "padding would leave bytes that are not set");

}  // namespace

Hash128 hash_bytes(std::span<const std::byte> bytes) noexcept
{
  const XXH128_hash_t hash = XXH3_128bits(bytes.data(), bytes.size());
  return {hash.low64, hash.high64};
}

Hash128 hash_tet(std::span<const GlobalIndex, 4> vertex_ids, std::span<const double, 12> xyz,
                 std::int32_t material) noexcept
{
  TetRecord record{.material = material};
  std::memcpy(record.vertex_ids, vertex_ids.data(), sizeof(record.vertex_ids));
  std::memcpy(record.xyz, xyz.data(), sizeof(record.xyz));
  return hash_bytes(std::as_bytes(std::span(&record, 1)));
}

Hash128 hash_tets(std::span<const LocalIndex> tet_vertices, std::span<const GlobalIndex> vertex_ids,
                  std::span<const double> xyz, std::span<const std::int32_t> materials) noexcept
{
  Hash128 sum;
  TetRecord record{};
  for (std::size_t t = 0; t < materials.size(); ++t) {
    for (std::size_t c = 0; c < 4; ++c) {
      const std::size_t vertex = at(tet_vertices[4 * t + c]);
      record.vertex_ids[c] = vertex_ids[vertex];
      std::memcpy(&record.xyz[3 * c], &xyz[3 * vertex], 3 * sizeof(double));
    }
    record.material = materials[t];
    sum += hash_bytes(std::as_bytes(std::span(&record, 1)));
  }
  return sum;
}

Hash128 hash_quadratic_tet(std::span<const GlobalIndex, 10> node_ids,
                           std::span<const double, 30> xyz, std::int32_t material) noexcept
{
  QuadraticTetRecord record{.material = material};
  std::memcpy(record.node_ids, node_ids.data(), sizeof(record.node_ids));
  std::memcpy(record.xyz, xyz.data(), sizeof(record.xyz));
  return hash_bytes(std::as_bytes(std::span(&record, 1)));
}

Hash128 hash_quadratic_tets(std::span<const LocalIndex> tet_nodes,
                            std::span<const GlobalIndex> node_ids, std::span<const double> xyz,
                            std::span<const std::int32_t> materials) noexcept
{
  Hash128 sum;
  std::array<GlobalIndex, 10> ids{};
  std::array<double, 30> positions{};
  for (std::size_t t = 0; t < materials.size(); ++t) {
    for (std::size_t c = 0; c < ids.size(); ++c) {
      const std::size_t node = at(tet_nodes[ids.size() * t + c]);
      ids[c] = node_ids[node];
      std::memcpy(&positions[3 * c], &xyz[3 * node], 3 * sizeof(double));
    }
    sum += hash_quadratic_tet(ids, positions, materials[t]);
  }
  return sum;
}

std::string to_hex(const Hash128& hash)
{
  return fmt::format("{:016x}{:016x}", hash.high, hash.low);
}

}  // namespace tessera
