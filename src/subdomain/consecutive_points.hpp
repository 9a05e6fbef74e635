// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tessera/comm/communicator.hpp"
#include "tessera/subdomain/mesh_part.hpp"

namespace tessera::subdomain {

/// @brief Gives a share's points numbers that follow the ranks: `point_numbers`,
/// `first_own_number`.
/// @note Collective. @pre the points that are no ghosts are in ascending order of their ids.
void number_consecutively(MeshShare& share, const comm::Communicator& comm);

}  // namespace tessera::subdomain
