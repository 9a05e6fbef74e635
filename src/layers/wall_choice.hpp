// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "tessera/layers/options.hpp"
#include "tessera/mesh/coarse_mesh.hpp"

namespace tessera::layers {

/// @brief Which entry each patch has, or kNoIndex. Local. Shape (num_patches).
/// @throws ConfigError if an entry fits no patch that can be a wall, or several fit one.
[[nodiscard]] std::vector<LocalIndex> entries_of_patches(const mesh::CoarseMesh& mesh,
                                                         std::span<const LayerOptions> options);

}  // namespace tessera::layers
