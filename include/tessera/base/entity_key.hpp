// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>

#include "tessera/base/hash.hpp"
#include "tessera/base/types.hpp"
#include "tessera/base/vec3.hpp"

/// Keys of the vertices, edges and triangles of a mesh that comes from files, the same on every
/// rank and in every piece. A mesh in the making needs none: mesh::HostPoint names its vertices.
namespace tessera {

/// @brief By what points of different pieces are recognised as the same vertex.
enum class VertexIdentity { ids, positions };

using VertexKey = std::array<std::uint64_t, 2>;    ///< (id, 0), or the position's 128-bit hash.
using EdgeKey = std::array<std::uint64_t, 2>;      ///< Of key_of_vertices().
using TriangleKey = std::array<std::uint64_t, 2>;  ///< Of key_of_vertices().

/// @brief Hash of a key that spreads records over ranks.
template <class Key>
[[nodiscard]] std::uint64_t hash_of(const Key& key)
{
  static_assert(std::has_unique_object_representations_v<Key>, "equal keys have equal bytes");
  return hash_bytes(std::as_bytes(std::span(&key, 1))).low;
}

/// @brief Key of an edge or a triangle: 128-bit hash of its vertices' keys. @pre they ascend.
template <std::size_t N>
[[nodiscard]] std::array<std::uint64_t, 2> key_of_vertices(const std::array<VertexKey, N>& vertices)
{
  const Hash128 hash = hash_bytes(std::as_bytes(std::span(vertices)));
  return {hash.low, hash.high};
}

[[nodiscard]] inline VertexKey key_of_id(GlobalIndex id)
{
  return {static_cast<std::uint64_t>(id), 0};
}

/// @brief Key by the bits of the position; the two zeros are one.
[[nodiscard]] inline VertexKey key_of_position(const Vec3& position)
{
  const Vec3 one_zero = position + Vec3{0.0, 0.0, 0.0};
  const Hash128 hash = hash_bytes(std::as_bytes(std::span(one_zero)));
  return {hash.low, hash.high};
}

}  // namespace tessera
