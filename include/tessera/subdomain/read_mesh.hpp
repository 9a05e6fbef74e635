// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "tessera/comm/communicator.hpp"
#include "tessera/comm/roll_call.hpp"
#include "tessera/subdomain/mesh_part.hpp"

namespace tessera::subdomain {

/// @brief Which tets become a rank's own.
enum class ReadPartition : int {
  files,     ///< Ranks take the piece files in their order, each some that stand together.
  balanced,  ///< Cut anew into one connected, balanced part a rank, as `tessera repartition` does.
};

/// @brief How read_mesh() deals a mesh out.
struct ReadOptions {
  ReadPartition partition = ReadPartition::files;
  /// Also number the points by ranks, as PETSc and DOLFINx want them: `point_numbers`.
  bool consecutive_points = false;
  int num_ghost_layers = 0;  ///< Layers of other ranks' tets around the share; see find_ghosts().
  /// How long this rank waits for the others to call read_mesh() too, seconds; infinity: for ever.
  double rank_timeout_s = comm::kRankTimeout_s;
};

/// @brief Reads this rank's share of a mesh, ours or another tool's; no rank holds the whole.
///
/// With ReadPartition::files a mesh that was made with `output.parts = P` keeps its parts on P
/// ranks. If there are more ranks than files, some ranks have no tets.
/// @note Collective; needs no Session.
/// @param[in] mesh An output folder, or a .pvtu or .vtu file.
/// @throws InputError on all ranks if a file is missing or damaged, if the pieces are no conforming
/// mesh, or if it is to be balanced and has fewer tets than ranks; MeshError if it cannot be cut.
/// UsageError on the ranks that have called it, if others do not in time: comm::roll_call().
[[nodiscard]] MeshShare read_mesh(const std::filesystem::path& mesh, const comm::Communicator& comm,
                                  const ReadOptions& options = {});

}  // namespace tessera::subdomain
