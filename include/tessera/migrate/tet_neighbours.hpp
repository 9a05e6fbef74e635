// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "tessera/base/types.hpp"
#include "tessera/comm/communicator.hpp"
#include "tessera/migrate/distributed_mesh.hpp"

namespace tessera::migrate {

/// @brief The tets behind the faces of a block's tets, face c being opposite to corner c.
/// Local; linear in time.
/// @return Shape (num_tets, 4); kNoIndex where no tet of the block is.
/// @throws InputError if a face is on more than two tets.
[[nodiscard]] std::vector<LocalIndex> tets_behind_faces(const MeshBlock& block);

/// @brief A face between a tet of this rank and one of another rank.
struct RemoteFace {
  Rank rank = 0;
  LocalIndex tet = 0;
  LocalIndex corner = 0;
};

/// @brief Which tets are behind the faces of this rank's tets, on all ranks.
struct TetNeighbours {
  /// Shape (num_tets, 4); below num_tets: a tet of this rank, from there on: num_tets + a row of
  /// `remote`; kNoIndex: none.
  std::vector<LocalIndex> behind{};
  /// By rank; two ranks have the faces between them in the same order.
  std::vector<RemoteFace> remote{};
};

/// @brief Finds the neighbours of all tets. Only ranks that share vertices exchange something.
/// @note Collective.
/// @throws InputError on all ranks if a face is on more than two tets.
[[nodiscard]] TetNeighbours find_neighbours(const comm::Communicator& comm,
                                            const DistributedMesh& mesh);

/// @brief The values of the tets behind the remote faces.
/// @note Collective.
/// @param[in] tet_values Shape (num_tets).
/// @return Shape (num_remote).
[[nodiscard]] std::vector<GlobalIndex> values_behind(const comm::Communicator& comm,
                                                     const TetNeighbours& neighbours,
                                                     const std::vector<GlobalIndex>& tet_values);

}  // namespace tessera::migrate
