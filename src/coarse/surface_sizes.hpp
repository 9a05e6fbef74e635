// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "tessera/coarse/options.hpp"
#include "tessera/coarse/patch_surface.hpp"

#include "coarse/size_function.hpp"

namespace tessera::coarse {

/// @brief Places of a surface where edges must be shorter than the largest size: where it bends,
/// where a curve bends, and along short curves. Local.
[[nodiscard]] std::vector<SizeSource> bent_places_of(const PatchSurface& surface,
                                                     const CoarseOptions& options);

}  // namespace tessera::coarse
