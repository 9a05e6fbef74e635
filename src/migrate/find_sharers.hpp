// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "tessera/base/index_lists.hpp"
#include "tessera/comm/communicator.hpp"

#include "migrate/join_points.hpp"

namespace tessera::migrate {

/// @brief Sharers of each vertex, as in DistributedMesh.
struct FoundSharers {
  IndexLists sharers{};
  bool has_contradiction = false;  ///< On any rank, two positions have one key.
};

/// @brief Finds out which vertices are on several ranks. Asks only about vertices on faces that
/// have no second tet on this rank. The keys of vertices say on which ranks they meet.
/// @note Collective.
/// @param[in] behind tets_behind_faces() of the block.
[[nodiscard]] FoundSharers find_sharers(const comm::Communicator& comm, const JoinedTets& joined,
                                        const std::vector<LocalIndex>& behind);

}  // namespace tessera::migrate
