// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "tessera/base/index_lists.hpp"
#include "tessera/comm/communicator.hpp"
#include "tessera/migrate/distributed_mesh.hpp"
#include "tessera/migrate/migrate.hpp"

namespace tessera::migrate {

/// @brief Sends the lists of shared vertices to their owners.
///
/// Both sides know in which order they come, so ids need not be sent.
/// @note Collective.
/// @pre Any two ranks have the vertices that they share in the same order.
/// @param[in] lists One of each vertex, ascending.
/// @return The union of the sharers' lists of each vertex that this rank owns; of others none.
[[nodiscard]] IndexLists unite_at_owners(const comm::Communicator& comm,
                                         const DistributedMesh& mesh, const IndexLists& lists,
                                         Traffic& traffic);

/// @brief The lists of the owners, at all sharers; the way back of unite_at_owners().
/// @note Collective. @pre as there.
[[nodiscard]] IndexLists lists_from_owners(const comm::Communicator& comm,
                                           const DistributedMesh& mesh, const IndexLists& lists,
                                           Traffic& traffic);

/// @brief The values of the owners, at all sharers.
/// @note Collective.
/// @param[in] values One of each vertex; only those at owners matter.
/// @pre Two ranks have the vertices that they share in the same order; ids need not be there.
[[nodiscard]] std::vector<GlobalIndex> values_from_owners(const comm::Communicator& comm,
                                                          const DistributedMesh& mesh,
                                                          std::vector<GlobalIndex> values,
                                                          Traffic& traffic);

}  // namespace tessera::migrate
