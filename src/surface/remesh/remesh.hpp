// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tessera/surface/options.hpp"
#include "tessera/surface/patch_surface.hpp"
#include "tessera/surface/reference.hpp"
#include "tessera/surface/size_function.hpp"

namespace tessera::surface {

class PeriodicRims;

/// @brief What remeshing makes.
struct Remeshed {
  PatchSurface surface{};
  bool is_without_cuts = false;  ///< It is known to cut itself nowhere.
};

/// @brief A surface with well-shaped triangles of the wanted sizes on the reference. Local.
///
/// Round by round its edges are split, collapsed and flipped and its vertices smoothed. Curves stay
/// curves and fixed vertices stay.
/// @cite botsch2004
///
/// A mesher that advances a front has to find a closed surface; this one starts with it. It takes
/// no step that would turn a triangle over, or make one worse than it has to be. So it ends with a
/// closed surface for any reference, but not always with good triangles. Whether a step makes
/// sheets cut each other is asked only if some do in the end: then all is done once more with steps
/// guarded where they do. If others cut each other then, every step is guarded, which takes twice
/// as long. The same arguments give the same bits.
///
/// Own code, because Debian 12 has no Mmg and CGAL's remesher is GPL.
/// @param[in] start  Where it begins: the reference's surface, or another one that has its patches
/// and curves, or some of them.
/// @param[in] model  If given, vertices on curves come to lie on its curves.
/// @param[in] rims  If given, curves that are images of each other get vertices that are.
/// @pre validate() accepts the reference's surface.
[[nodiscard]] Remeshed remesh(const SurfaceReference& reference, const PatchSurface& start,
                              const SizeFunction& sizes, const model::Model* model = nullptr,
                              const PeriodicRims* rims = nullptr);

/// @brief The sizes that the options and the surface ask for: shorter edges where it bends, in
/// narrow strips and at thin walls, and where the model itself wants them. Local.
[[nodiscard]] SizeFunction size_function_of(const SurfaceReference& reference,
                                            const CoarseOptions& options);

/// @brief Both, from the reference's surface. Local.
[[nodiscard]] PatchSurface remesh(const SurfaceReference& reference, const CoarseOptions& options);

}  // namespace tessera::surface
