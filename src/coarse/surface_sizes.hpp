// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "tessera/coarse/options.hpp"
#include "tessera/coarse/patch_surface.hpp"

namespace tessera::coarse {

/// @brief Wanted edge length at each vertex. It is the largest size, but less where the surface or
/// a curve bends or a curve is short, and grows from there with the grading. Local.
[[nodiscard]] std::vector<double> surface_sizes(const PatchSurface& surface,
                                                const CoarseOptions& options);

/// @brief Sizes of a surface as it is: the mean of the edges at each vertex. At the given triangles
/// it is half of that, and grows from there with the grading. Local.
[[nodiscard]] std::vector<double> finer_sizes(const PatchSurface& surface,
                                              const std::vector<std::size_t>& triangles,
                                              double grading);

}  // namespace tessera::coarse
