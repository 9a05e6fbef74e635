// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "tessera/comm/communicator.hpp"
#include "tessera/mesh/mesh_arrays.hpp"

#include "migrate/join_points.hpp"

namespace tessera::migrate {

/// @brief What there is to match: this rank's tets, and the boundary pieces that it has read.
struct BoundaryMatch {
  const JoinedTets& joined;
  const std::vector<LocalIndex>& behind;    ///< tets_behind_faces() of the block.
  const std::vector<GlobalIndex>& tet_ids;  ///< As in the files; empty if they have none.
  const std::vector<mesh::MeshArrays>& pieces;
  bool has_inside_patches = false;  ///< Any face of a tet may be on the boundary file's list.
  bool has_boundary = false;        ///< There is a boundary file; the same on all ranks.
  VertexIdentity identity = VertexIdentity::ids;
};

/// @brief Finds the tets behind the triangles of the boundary file, and adds the triangles to the
/// blocks of the ranks that have these tets, with dense ids. Their keys meet on ranks that follow
/// from the keys. Of two tets, on different materials, it is the one that the file names.
/// @note Collective.
/// @param[out] block Gets the boundary triangles.
/// @throws InputError on all ranks if a triangle has no tet or the file lacks one.
void attach_boundary(const comm::Communicator& comm, const BoundaryMatch& match, MeshBlock& block);

}  // namespace tessera::migrate
