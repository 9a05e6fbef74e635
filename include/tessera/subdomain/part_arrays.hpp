// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <vector>

#include "tessera/base/index_lists.hpp"
#include "tessera/migrate/assemble.hpp"
#include "tessera/migrate/distributed_mesh.hpp"
#include "tessera/migrate/ghosts.hpp"
#include "tessera/subdomain/piece_arrays.hpp"

namespace tessera::subdomain {

/// @brief A mesh that is ready to be written part by part. Borrowed.
struct PartContext {
  const migrate::DistributedMesh& mesh;
  const IndexLists& vertex_parts;  ///< migrate::parts_of_vertices().
  const std::vector<migrate::TetColumn>& columns;
  const std::map<std::string, std::vector<std::string>>& field_texts;
  int num_ghost_layers = 0;
};

/// @brief What the files of one part hold; its own tets and points come before the ghosts. Local;
/// linear in the rank's mesh.
/// @param[in] ghosts The copies that are written with it, or nullptr.
[[nodiscard]] PieceArrays part_arrays(const PartContext& context, LocalIndex part,
                                      const migrate::GhostTets* ghosts);

}  // namespace tessera::subdomain
