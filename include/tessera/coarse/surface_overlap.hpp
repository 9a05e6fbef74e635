// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "tessera/coarse/patch_surface.hpp"

namespace tessera::coarse {

/// @brief Two triangles of a surface that cut each other.
struct Overlap {
  std::size_t first = 0;
  std::size_t second = 0;
  Vec3 place{};  ///< Where an edge of one goes through the other.
};

/// @brief Where a surface cuts itself, as where its triangles are longer than a gap is wide. Local.
///
/// Gives the pairs of triangles, ascending, of which an edge of one goes through the other.
/// Triangles that share an edge, only touch, or lie in one plane are no such pair. O(n log n) for a
/// surface whose triangles are much smaller than it.
[[nodiscard]] std::vector<Overlap> find_overlaps(const PatchSurface& surface);

/// @brief Those of the overlaps of a surface where both triangles bound the same material, so that
/// it cannot be filled. Local.
[[nodiscard]] std::vector<Overlap> within_bodies(std::vector<Overlap> overlaps,
                                                 const PatchSurface& surface);

}  // namespace tessera::coarse
