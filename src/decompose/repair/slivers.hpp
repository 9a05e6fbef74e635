// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "decompose/partition/tet_partition.hpp"

namespace tessera::decompose {

/// @brief Face-connected parts from parts that may be in several components.
///
/// The heaviest component of a part stays. Of the others, heavy ones become parts of their own.
/// Light ones (slivers) join the component with which they share the most expensive seam.
/// @param[in] tet_part Shape (num_tets), in [0, num_parts).
[[nodiscard]] TetPartition connect_parts(const TetGraph& graph,
                                         const std::vector<LocalIndex>& tet_part,
                                         LocalIndex num_parts);

}  // namespace tessera::decompose
