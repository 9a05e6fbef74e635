// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "tessera/surface/options.hpp"
#include "tessera/surface/patch_surface.hpp"
#include "tessera/surface/size_function.hpp"

namespace tessera::surface {

/// @brief Places of a surface where edges must be shorter than the largest size: where it bends,
/// where a curve bends, and along short curves. Local.
[[nodiscard]] std::vector<SizeSource> bent_places_of(const PatchSurface& surface,
                                                     const CoarseOptions& options);

}  // namespace tessera::surface
