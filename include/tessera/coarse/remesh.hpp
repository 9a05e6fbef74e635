// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "tessera/coarse/options.hpp"
#include "tessera/coarse/patch_surface.hpp"
#include "tessera/coarse/surface_reference.hpp"

namespace tessera::coarse {

/// @brief A surface with well-shaped triangles of the wanted sizes on the reference. Local.
///
/// Round by round its edges are split, collapsed and flipped and its vertices smoothed. Curves stay
/// curves and fixed vertices stay.
/// @cite botsch2004
///
/// A mesher that advances a front has to find a closed surface; this one starts with it. It takes
/// no step that would turn a triangle over, or make one worse than it has to be. So it ends with a
/// closed surface for any reference, but not always with good triangles. The same arguments give
/// the same bits.
///
/// Own code, because Debian 12 has no Mmg and CGAL's remesher is GPL.
/// @pre validate() accepts the reference's surface.
[[nodiscard]] PatchSurface remesh(const SurfaceReference& reference, const CoarseOptions& options);

/// @brief The same, beginning with another surface that has the reference's patches and curves, or
/// some of them. Local.
[[nodiscard]] PatchSurface remesh(const SurfaceReference& reference, const PatchSurface& start,
                                  const CoarseOptions& options);

/// @brief A remeshed surface once more, with edges of half their length around some triangles.
/// Local. @pre `surface` is what remesh() made of the same reference.
[[nodiscard]] PatchSurface remesh_finer(const SurfaceReference& reference,
                                        const PatchSurface& surface,
                                        const std::vector<std::size_t>& triangles,
                                        const CoarseOptions& options);

}  // namespace tessera::coarse
