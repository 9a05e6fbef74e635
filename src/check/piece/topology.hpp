// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "check/findings.hpp"
#include "check/piece/mesh.hpp"
#include "check/piece/quality.hpp"

namespace tessera::check {

/// @brief One side of a triangle: its tet and the outward order of its vertices.
struct SurfaceTriangle {
  std::array<LocalIndex, 3> vertices{};  ///< Of the PieceMesh.
  LocalIndex cell = 0;
  LocalIndex component = 0;  ///< Of the piece.
  bool is_open = true;       ///< On one tet of the piece.
  bool is_seam = false;      ///< On two, of two subdomains of one material.
};

/// @brief What a piece's tets are by themselves, and which triangles other pieces must see.
struct PieceTopology {
  /// Three kinds of triangles: those on one tet; those between two subdomains or materials, both
  /// sides; and those with all vertices on triangles on one tet, both sides, as a wrong piece may
  /// have a third tet there.
  std::vector<SurfaceTriangle> surface{};
  GlobalIndex num_inner_triangles = 0;  ///< All others.
  GlobalIndex num_edges = 0;
  LocalIndex num_components = 0;  ///< Sets of tets joined through triangles.
};

/// @brief Outward triangle of a positive tet opposite to each corner.
inline constexpr std::array<std::array<std::size_t, 3>, 4> kOutwardCorners{
    {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};

/// @brief Matches the triangles of a piece and counts its edges. Local; O(number of tets).
///
/// Reported: triangles with more than two tets or two on one side, and duplicate tets.
/// @param[in,out] lengths Gets the length of each edge once for each subdomain that has it.
[[nodiscard]] PieceTopology analyse_topology(const PieceMesh& mesh, EdgeLengths& lengths,
                                             Findings& findings);

/// @brief Whether (a, b, c) is an odd permutation of its ascending order. @pre all different.
template <class Key>
[[nodiscard]] constexpr bool is_odd(const Key& a, const Key& b, const Key& c)
{
  return ((b < a) != (c < b)) != (c < a);
}

}  // namespace tessera::check
