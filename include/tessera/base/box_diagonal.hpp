// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <span>

#include "tessera/base/vec3.hpp"

namespace tessera {

/// @brief Lowest and highest corner of the smallest box along the axes that holds all points.
/// Local.
/// @param[in] xyz Shape (n, 3), n > 0.
[[nodiscard]] std::array<Vec3, 2> bounding_box(std::span<const double> xyz);

/// @brief Diagonal of the smallest box along the axes that holds all points; 0 without any. Local.
/// @param[in] xyz Shape (n, 3).
[[nodiscard]] double box_diagonal(std::span<const double> xyz);

}  // namespace tessera
