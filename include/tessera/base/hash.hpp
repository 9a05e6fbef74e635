// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <tuple>

#include "tessera/base/types.hpp"

namespace tessera {

/// @brief 128-bit hash that is summed half by half, each modulo 2^64. So sums do not depend on
/// order, and an MPI sum of the halves is the sum of the hashes.
struct Hash128 {
  std::uint64_t low = 0;
  std::uint64_t high = 0;

  static auto fields(auto& self) { return std::tie(self.low, self.high); }

  friend bool operator==(const Hash128&, const Hash128&) = default;

  Hash128& operator+=(const Hash128& other) noexcept
  {
    low += other.low;
    high += other.high;
    return *this;
  }

  Hash128& operator-=(const Hash128& other) noexcept
  {
    low -= other.low;
    high -= other.high;
    return *this;
  }
};

/// @brief XXH3-128 of a byte range. Local.
[[nodiscard]] Hash128 hash_bytes(std::span<const std::byte> bytes) noexcept;

/// @brief Hash of one tet for a mesh digest. Local.
///
/// It covers, in the order given, the tet's global vertex ids, the bits of its positions (corner by
/// corner, shape (4, 3)) and its material. The digest of a mesh is the sum of this over its tets.
/// Who writes and who checks use this one definition.
[[nodiscard]] Hash128 hash_tet(std::span<const GlobalIndex, 4> vertex_ids,
                               std::span<const double, 12> xyz, std::int32_t material) noexcept;

/// @brief Sum of hash_tet() over many tets, in less time. Local.
/// @param[in] tet_vertices Shape (num_tets, 4): rows of `vertex_ids` and `xyz`.
/// @param[in] vertex_ids Shape (num_vertices).
/// @param[in] xyz Shape (num_vertices, 3).
/// @param[in] materials Shape (num_tets).
[[nodiscard]] Hash128 hash_tets(std::span<const LocalIndex> tet_vertices,
                                std::span<const GlobalIndex> vertex_ids,
                                std::span<const double> xyz,
                                std::span<const std::int32_t> materials) noexcept;

/// @brief The same of a tet of second order: shapes (10) and (10, 3), in the order of VTK's nodes.
[[nodiscard]] Hash128 hash_quadratic_tet(std::span<const GlobalIndex, 10> node_ids,
                                         std::span<const double, 30> xyz,
                                         std::int32_t material) noexcept;

/// @brief Sum of hash_quadratic_tet() over many tets. Local. @param[in] tet_nodes Shape
/// (num_tets, 10). The rest is as for hash_tets().
[[nodiscard]] Hash128 hash_quadratic_tets(std::span<const LocalIndex> tet_nodes,
                                          std::span<const GlobalIndex> node_ids,
                                          std::span<const double> xyz,
                                          std::span<const std::int32_t> materials) noexcept;

/// @brief 32 lower-case hexadecimal digits, the high half first.
[[nodiscard]] std::string to_hex(const Hash128& hash);

}  // namespace tessera
