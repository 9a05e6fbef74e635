// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <vector>

#include "tessera/base/types.hpp"
#include "tessera/comm/communicator.hpp"
#include "tessera/migrate/distributed_mesh.hpp"
#include "tessera/migrate/migrate.hpp"

namespace tessera::migrate {

/// @brief Moves every tet to the rank of its part, rank_of_part().
/// @note Collective. @param[in,out] traffic as in migrate().
[[nodiscard]] DistributedMesh migrate_to_parts(const comm::Communicator& comm,
                                               const DistributedMesh& mesh, LocalIndex num_parts,
                                               Traffic& traffic);

/// @brief Largest part that is allowed: the average times `max_balance`, but no less than a share
/// that is rounded up. Local.
[[nodiscard]] GlobalIndex largest_allowed(GlobalIndex num_tets, LocalIndex num_parts,
                                          double max_balance);

/// @brief What cut_into_parts() was asked for.
struct PartRequest {
  LocalIndex num_parts = 1;
  double max_balance = 1.03;  ///< Largest part over the average; see largest_allowed().
  /// Tets that are to stay in one part: of each the first one of its group, which is on the same
  /// rank. Shape (num_tets). None: each goes for itself.
  std::function<std::vector<LocalIndex>(const MeshBlock&)> groups_of{};
};

/// @brief How cut_into_parts() came to its result; the same on all ranks.
struct CutFigures {
  int num_tries = 0;   ///< Partitions that were made.
  int num_rounds = 0;  ///< Migrations that mended parts.
};

/// @brief What cut_into_parts() has made.
struct RepartitionResult {
  DistributedMesh mesh{};  ///< With the parts, each on its rank.
  CutFigures figures{};
};

/// @brief Cuts the mesh into parts that are connected and balanced, with few triangles between
/// them, and moves each part to its rank.
///
/// Of a part in several components all but the largest go to the neighbour with which they share
/// most triangles. The mesh is cut several times, until two results are balanced, and the better
/// one is taken. If none is balanced after some tries, parts that are too large give tets from
/// their surface to smaller neighbours, so that both stay connected. A part stays in several
/// components if no other part touches them.
/// @note Collective. For a given number of ranks the result is always the same.
/// @param[in,out] traffic What this rank sends in migrations is added to it.
/// @pre 1 <= num_parts <= number of tets on all ranks.
/// @throws MeshError on all ranks if PT-Scotch gives up; ConfigError as require_partitioner().
[[nodiscard]] RepartitionResult cut_into_parts(const comm::Communicator& comm, DistributedMesh mesh,
                                               const PartRequest& request, Traffic& traffic);

}  // namespace tessera::migrate
