// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tessera/base/vec3.hpp"
#include "tessera/model/stl_file.hpp"
#include "tessera/surface/patch_surface.hpp"

namespace tessera::testing {

/// @brief Adds a soup as a patch with material 1 below it and none above, scaled and then shifted.
/// It has no curves. Corners at one place are one vertex.
void add_patch(const model::TriangleSoup& soup, double scale, const Vec3& shift,
               surface::PatchSurface& surface);

}  // namespace tessera::testing
