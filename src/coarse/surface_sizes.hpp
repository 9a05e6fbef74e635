// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "tessera/coarse/options.hpp"
#include "tessera/coarse/patch_surface.hpp"

namespace tessera::coarse {

/// @brief Wanted edge length at each vertex: the largest size, less where the surface or a curve
/// bends or a curve is short, and growing from there with the grading. Local.
[[nodiscard]] std::vector<double> surface_sizes(const PatchSurface& surface,
                                                const CoarseOptions& options);

}  // namespace tessera::coarse
