// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "tessera/base/types.hpp"

namespace tessera::optimize {

// A *corner* is 4 t + c: corner c of tet t, and the face opposite to it. In an array of shape
// (num_tets, 4) it is the place of its entry.
using Corner = LocalIndex;

using TetVertices = std::array<LocalIndex, 4>;

// Across a face of the boundary that is an outer triangle of group 0, and of any; kNoIndex is
// across the others.
inline constexpr Corner kOuterFace = -2;
[[nodiscard]] constexpr Corner outer_face(LocalIndex group) noexcept { return kOuterFace - group; }

[[nodiscard]] constexpr bool is_boundary(Corner across) noexcept { return across < 0; }
[[nodiscard]] constexpr bool is_outer(Corner across) noexcept { return across <= kOuterFace; }

[[nodiscard]] constexpr LocalIndex tet_of(Corner corner) noexcept { return corner >> 2; }

// The other corners of its tet: the face opposite to it, outward in a positive tet.
[[nodiscard]] constexpr std::array<Corner, 3> face_of(Corner corner) noexcept
{
  return {corner ^ 1, corner ^ 2, corner ^ 3};
}

[[nodiscard]] inline std::array<LocalIndex, 3> face_vertices(
    const std::vector<LocalIndex>& tet_vertices, Corner corner)
{
  return {tet_vertices[at(corner ^ 1)], tet_vertices[at(corner ^ 2)], tet_vertices[at(corner ^ 3)]};
}

}  // namespace tessera::optimize
