// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "tessera/migrate/distributed_mesh.hpp"

namespace tessera::migrate {

/// @brief Where each of `some` stands in `all`. Local. @pre both ascend, and `all` holds `some`.
[[nodiscard]] std::vector<LocalIndex> places_of(std::span<const GlobalIndex> some,
                                                std::span<const GlobalIndex> all);

/// @brief One block of all that the blocks hold; what several of them have is in it once. Local.
/// @pre The blocks have equally many columns, but for those without tets.
[[nodiscard]] MeshBlock merge_blocks(std::span<const MeshBlock> blocks);

}  // namespace tessera::migrate
