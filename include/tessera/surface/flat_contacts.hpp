// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "tessera/surface/patch_surface.hpp"

namespace tessera::surface {

/// @brief Where parts of a surface lie flat on each other: pairs of triangles that are in one plane
/// within `tolerance` and cover each other by more than it, ascending. Local.
///
/// find_overlaps() sees no such pair. Triangles that share an edge or a side are none, nor are
/// those narrower than the tolerance. O(n log n) as there.
[[nodiscard]] std::vector<std::array<std::size_t, 2>> find_flat_contacts(
    const PatchSurface& surface, double tolerance);

}  // namespace tessera::surface
