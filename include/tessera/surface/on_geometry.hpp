// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tessera/model/model.hpp"
#include "tessera/surface/defeature.hpp"
#include "tessera/surface/options.hpp"
#include "tessera/surface/overlap.hpp"
#include "tessera/surface/reference.hpp"

namespace tessera::surface {

/// @brief Moves the vertices of a surface that followed a tessellation onto the model itself, those
/// on curves onto the curves. One that would go farther than half its shortest edge, or turn a
/// triangle, stays: the search found another sheet. Local.
/// @param[in] reference  The tessellation; its patch and curve numbers are the model's.
/// @throws GeometryError if a projection fails.
void put_on_geometry(PatchSurface& surface, const SurfaceReference& reference,
                     const model::Model& model);

/// @brief A surface on the geometry.
struct RemeshedSurface {
  PatchSurface surface{};
  Defeatured defeatured{};  ///< What `options.defeature` has merged in it.
};

/// @brief Remeshes a tessellation and puts it on the geometry. Local.
///
/// What is smaller than `options.defeature` is merged in what came out, which is remeshed then.
///
/// A surface may then cut itself, as at a gap that is narrower than its triangles are long. The
/// same is done again with shorter edges at forbidden cuts, a few times; at others as long as that
/// helps. It may still cut itself in the end: forbidden_overlaps() says where. Triangles may fold
/// on their first level of refinement, as in a strip that is narrower than arcs beside it are high.
/// There edges get shorter as well, as long as that leaves fewer of them.
/// @param[in] reference  As put_on_geometry().
/// @throws GeometryError if a projection fails.
[[nodiscard]] RemeshedSurface remesh_on_geometry(const SurfaceReference& reference,
                                                 const model::Model& model,
                                                 const CoarseOptions& options,
                                                 Forbidden forbidden = Forbidden::all_cuts);

}  // namespace tessera::surface
