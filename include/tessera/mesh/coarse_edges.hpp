// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "tessera/mesh/coarse_mesh.hpp"

namespace tessera::mesh {

/// @brief The edges of the tets of a coarse mesh. Shape (num_edges, 2): each row ascends, and the
/// rows as well. Local; O(n log n).
[[nodiscard]] std::vector<LocalIndex> coarse_edges(const CoarseMesh& coarse);

}  // namespace tessera::mesh
