// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "tessera/base/types.hpp"

namespace tessera::mesh {

/// @brief Corners of the face opposite to corner i of a positive tet; its normal points outwards.
inline constexpr std::array<std::array<std::size_t, 3>, 4> kTetFaceCorners{
    {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};

/// @brief The six edges of a tet as pairs of corners.
inline constexpr std::array<std::array<std::size_t, 2>, 6> kTetEdgeCorners{
    {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};

/// @brief The two vertices in ascending order: the key of an edge.
[[nodiscard]] constexpr std::array<LocalIndex, 2> sorted_edge(LocalIndex a, LocalIndex b) noexcept
{
  return {std::min(a, b), std::max(a, b)};
}

/// @brief The three vertices in ascending order: the key of a triangle.
[[nodiscard]] constexpr std::array<LocalIndex, 3> sorted_triangle(LocalIndex a, LocalIndex b,
                                                                  LocalIndex c) noexcept
{
  const LocalIndex low = std::min({a, b, c});
  const LocalIndex high = std::max({a, b, c});
  return {low, a ^ b ^ c ^ low ^ high, high};  // What is left of the three.
}

/// @brief Whether (a, b, c) is an even permutation of its ascending order. @pre all different.
[[nodiscard]] constexpr bool is_even_triangle(LocalIndex a, LocalIndex b, LocalIndex c) noexcept
{
  return (a < b) + (b < c) + (c < a) == 2;
}

/// @brief A tet's vertices in ascending order.
struct SortedTet {
  std::array<LocalIndex, 4> vertices{};
  bool is_even = true;  ///< Whether the order the tet had is an even permutation of this one.

  /// @brief Whether the face opposite to `vertices[i]`, seen from outside, is an even permutation
  /// of its ascending order. @see is_even_triangle, kTetFaceCorners
  [[nodiscard]] constexpr bool is_even_face(std::size_t i) const noexcept
  {
    return (i % 2 == 0) == is_even;
  }
};

/// @brief Sorts the vertices of one tet. @pre all different.
[[nodiscard]] constexpr SortedTet sorted_tet(std::span<const LocalIndex, 4> vertices) noexcept
{
  SortedTet tet{{vertices[0], vertices[1], vertices[2], vertices[3]}};
  const auto order = [&tet](std::size_t low, std::size_t high) {
    const LocalIndex a = tet.vertices[low];
    const LocalIndex b = tet.vertices[high];
    tet.vertices[low] = std::min(a, b);
    tet.vertices[high] = std::max(a, b);
    tet.is_even = tet.is_even != (b < a);
  };
  order(0, 1);
  order(2, 3);
  order(0, 2);
  order(1, 3);
  order(1, 2);
  return tet;
}

/// @brief One triangle of a tet mesh and the one or two tets it belongs to.
struct TriangleTets {
  std::array<LocalIndex, 3> vertices{};                ///< Ascending.
  std::array<LocalIndex, 2> tets{kNoIndex, kNoIndex};  ///< Ascending; the second may be kNoIndex.
  std::array<LocalIndex, 2> corners{kNoIndex, kNoIndex};  ///< Corner of that tet opposite to it.
};

/// @brief The four faces of each tet, opposite to its corners in their order; a face of two tets
/// stands twice. Shape (4 * num_tets); vertices of a face ascend. Local.
/// @param[in] tet_vertices Shape (num_tets, 4).
[[nodiscard]] std::vector<std::array<LocalIndex, 3>> faces_of_tets(
    std::span<const LocalIndex> tet_vertices);

/// @brief All triangles of the tets, in ascending order of their vertices. Local; O(n log n).
/// @param[in] tet_vertices Shape (num_tets, 4).
/// @throws MeshError if a triangle belongs to more than two tets.
[[nodiscard]] std::vector<TriangleTets> triangles_of_tets(std::span<const LocalIndex> tet_vertices);

/// @brief Number of different edges. Local; linear. @param[in] tet_vertices Shape (num_tets, 4).
[[nodiscard]] GlobalIndex count_edges(std::span<const LocalIndex> tet_vertices,
                                      LocalIndex num_vertices);

}  // namespace tessera::mesh
