// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "tessera/base/types.hpp"

namespace tessera::verify {

/// @brief V - E + F - T of every part of a tet mesh; 1 for a ball.
/// @param[in] tet_vertices Shape (num_tets, 4). @param[in] tet_part Shape (num_tets); parts are
/// dense.
/// @return Shape (num_parts). Local; linear.
[[nodiscard]] std::vector<GlobalIndex> euler_characteristics(
    std::span<const LocalIndex> tet_vertices, std::span<const LocalIndex> tet_part);

}  // namespace tessera::verify
