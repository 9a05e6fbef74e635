// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <span>

#include "tessera/model/model.hpp"
#include "tessera/surface/reference.hpp"

namespace tessera::surface {

/// @brief A translation between two sides, found from triangles, which are chords of what is
/// curved; made exact by what is not: the curves of the model. Local.
/// @param[in] curves Curves of the one side, and their images on the other one.
/// @return The shift; as given if the curves leave a direction open.
/// @throws GeometryError if a projection fails.
[[nodiscard]] Vec3 shift_by_curves(const SurfaceReference& reference, const model::Model& model,
                                   std::span<const std::array<LocalIndex, 2>> curves, Vec3 shift);

}  // namespace tessera::surface
