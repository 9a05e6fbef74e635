// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

namespace tessera {

/// @brief Diagonal of the smallest box along the axes that holds all points; 0 without any. Local.
/// @param[in] xyz Shape (n, 3).
[[nodiscard]] double box_diagonal(std::span<const double> xyz);

}  // namespace tessera
