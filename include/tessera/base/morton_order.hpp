// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "tessera/base/types.hpp"

namespace tessera {

/// @brief Rows of points in the order of a Morton curve with 2^30 cells; equal cells by row. What
/// is near in space is then near in memory. Local.
/// @param[in] values Shape (num_points, width): x, y, z, and what else a row has.
/// @pre width >= 3; points are finite, and so are their differences; at most 2^31 points.
[[nodiscard]] std::vector<LocalIndex> morton_order(std::span<const double> values,
                                                   std::size_t width = 3);

}  // namespace tessera
