// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "tessera/coarse/options.hpp"
#include "tessera/coarse/patch_surface.hpp"

namespace tessera::coarse {

/// @brief The vertices that each vertex has an edge to.
using Neighbours = std::vector<std::vector<LocalIndex>>;

/// @brief Makes sizes smaller, so that none is larger than a neighbour's plus `grading` times the
/// way to it. Local.
void grade(std::span<const Vec3> vertex_xyz, const Neighbours& neighbours, double grading,
           std::vector<double>& sizes);

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
