// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "tessera/model/model.hpp"
#include "tessera/surface/patch_surface.hpp"
#include "tessera/surface/reference.hpp"

namespace tessera::surface {

/// @brief Triangles that fold on their first level of refinement, or nearly so, in ascending order.
/// Local.
///
/// There an edge is too long for what it stands for: its arc is higher than the triangle beside it,
/// as in a strip between two curves. What cannot be projected counts as straight.
/// @pre The surface is a remeshed one of the reference, and lies on the model.
[[nodiscard]] std::vector<std::size_t> folding_triangles(const PatchSurface& surface,
                                                         const SurfaceReference& reference,
                                                         const model::Model& model);

}  // namespace tessera::surface
