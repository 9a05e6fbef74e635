// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "tessera/surface/patch_surface.hpp"

namespace tessera::surface {

/// @brief Two triangles of a surface that cut each other.
struct Overlap {
  std::size_t first = 0;
  std::size_t second = 0;
  Vec3 place{};  ///< Where an edge of one goes through the other.
};

/// @brief Where a surface cuts itself, as where its triangles are longer than a gap is wide. Local.
///
/// Gives the pairs of triangles, ascending, of which an edge of one goes through the other, or
/// through an edge or a corner of it. Triangles that share an edge, lie in one plane, or touch with
/// a corner inside of the other only are no such pair. O(n log n) for a surface whose triangles are
/// much smaller than it.
[[nodiscard]] std::vector<Overlap> find_overlaps(const PatchSurface& surface);

/// @brief Where a surface must not cut itself. Each body is filled by itself, so that bodies may
/// cut each other where they are known to touch only.
enum class Forbidden { all_cuts, cuts_within_bodies };

/// @brief Those of find_overlaps() that are forbidden: within bodies both triangles bound the same
/// material. Local.
[[nodiscard]] std::vector<Overlap> forbidden_overlaps(const PatchSurface& surface,
                                                      Forbidden forbidden);

}  // namespace tessera::surface
