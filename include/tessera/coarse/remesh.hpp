// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "tessera/coarse/options.hpp"
#include "tessera/coarse/patch_surface.hpp"
#include "tessera/coarse/surface_reference.hpp"

namespace tessera::coarse {

/// @brief A surface with well-shaped triangles of the wanted sizes on the reference: its edges are
/// split, collapsed and flipped and its vertices smoothed, round by round @cite botsch2004; curves
/// stay curves and fixed vertices stay.
///
/// What a mesher that advances a front needs to find, this has from the start: a closed surface. A
/// step that would make a triangle worse than it has to be, or turn one over, is not taken; so it
/// ends with a closed surface for any reference, if not always with good triangles. The same
/// arguments give the same bits. Local.
/// @pre validate() accepts the reference's surface.
[[nodiscard]] PatchSurface remesh(const SurfaceReference& reference, const CoarseOptions& options);

/// @brief A remeshed surface once more, with edges of half their length around some triangles.
/// Local. @pre `surface` is what remesh() made of the same reference.
[[nodiscard]] PatchSurface remesh_finer(const SurfaceReference& reference,
                                        const PatchSurface& surface,
                                        const std::vector<std::size_t>& triangles,
                                        const CoarseOptions& options);

}  // namespace tessera::coarse
