// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "tessera/comm/communicator.hpp"

#include "support/box_pieces.hpp"
#include "support/shared_folder.hpp"

namespace tessera::testing {

/// @brief 8 pieces of 48 tets; each side of the cube has 5 x 5 points and 32 triangles.
inline const BoxPieces kPeriodicBox(1, 2);

/// @brief Writes the box to mesh.pvtu in a folder, with patches left and right (x), front and back
/// (y), and rest. Collective.
/// @param[in] pairs As mesh::to_texts() has them.
void write_periodic_box(const SharedFolder& folder, const std::vector<std::string>& pairs,
                        const comm::Communicator& comm);

}  // namespace tessera::testing
