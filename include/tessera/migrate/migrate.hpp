// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "tessera/base/types.hpp"
#include "tessera/comm/communicator.hpp"
#include "tessera/migrate/distributed_mesh.hpp"

namespace tessera::migrate {

/// @brief What this rank sent to others.
struct Traffic {
  GlobalIndex num_messages = 0;
  GlobalIndex num_bytes = 0;
};

/// @brief Moves tets to other ranks, with the vertices and boundary triangles that belong to them.
///
/// Only the owner of a vertex finds its new sharers. The old sharers tell the owner where they send
/// their tets, and the owner tells the new sharers. That takes two sparse exchanges: sharers to
/// owners, then tets and lists of sharers to where they belong. Nothing is gathered. A rank sends
/// only to ranks that it shares a vertex with, sends tets to, or whose vertices it owned.
///
/// The result does not depend on where the tets were before. Sending every tet to where it is
/// changes nothing, bit for bit.
/// @note Collective.
/// @param[in] mesh This rank's share.
/// @param[in] tet_rank Shape (num_tets): where each tet shall be. Ranks may become empty.
/// @param[in,out] traffic If given, what this rank sends is added to it.
/// @return This rank's new share.
/// @throws MeshError on all ranks if a rank does not exist or the arrays do not fit together.
[[nodiscard]] DistributedMesh migrate(const comm::Communicator& comm, const DistributedMesh& mesh,
                                      std::span<const Rank> tet_rank, Traffic* traffic = nullptr);

}  // namespace tessera::migrate
