// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "tessera/base/types.hpp"

#include "io/vtu/vtu_elements.hpp"

namespace tessera::io {

/// @brief Tets that fill the cells which have a volume, shape (num_tets, 4), of any orientation.
/// @param[in] num_points Of the piece. @throws InputError if a cell is corrupt, or of a kind with a
/// volume that has no fixed corners.
[[nodiscard]] std::vector<LocalIndex> split_into_tets(const MixedCells& cells,
                                                      std::size_t num_points);

}  // namespace tessera::io
