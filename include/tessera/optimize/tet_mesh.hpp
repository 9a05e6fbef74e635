// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "tessera/base/types.hpp"

namespace tessera::optimize {

/// @brief Tets to be made better.
///
/// The *boundary* is made of the triangles that belong to one tet. Its vertices never move and its
/// triangles stay as they are, whatever `vertex_fixed` says.
struct TetMesh {
  std::vector<double> vertex_xyz{};        ///< Shape (num_vertices, 3).
  std::vector<LocalIndex> tet_vertices{};  ///< Shape (num_tets, 4); positive, VTK's order.

  /// Shape (num_vertices); 1: a vertex off the boundary that must stay, too. Optional.
  std::vector<std::uint8_t> vertex_fixed{};

  /// Shape (num_tets, 4): what lies across the face opposite to corner c of tet t. It is kNoIndex
  /// if that face is on the boundary, and 4 u + d if it is opposite to corner d of tet u.
  /// Optional: a caller that knows the neighbours saves the search for them. It is checked.
  std::vector<LocalIndex> tet_neighbours{};

  /// Shape (num_outer, 3): triangles of the boundary of which a tet should have one of each group
  /// at most, in any order. No swap or collapse gives a tet a second one; Step::divide divides
  /// those that have several. Others than those of the boundary are ignored. Optional.
  std::vector<LocalIndex> outer_triangles{};

  /// Shape (num_outer): the group of each outer triangle, from 0 to 2^31 - 2. Optional: without it
  /// all are of one.
  std::vector<LocalIndex> outer_group{};
};

}  // namespace tessera::optimize
