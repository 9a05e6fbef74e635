// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "tessera/migrate/assemble.hpp"
#include "tessera/migrate/distributed_mesh.hpp"

namespace tessera::subdomain {

/// @brief Of each tet the first one of its column of layers, the tet itself in no layer. The cell
/// arrays `layer` and `tet_of_prism` say it, as the tets of a column have ids that follow one
/// another. Shape (num_tets). Local; linear.
/// @param[in] columns Of the block.
[[nodiscard]] std::vector<LocalIndex> columns_of_layers(
    const migrate::MeshBlock& block, std::span<const migrate::TetColumn> columns);

}  // namespace tessera::subdomain
