// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tessera/base/index_lists.hpp"
#include "tessera/base/types.hpp"

namespace tessera::subdomain {

/// @brief Part of a tet mesh as plain arrays, row-major. Ids are those of the whole mesh, dense
/// from 0; a point on a seam stands in every part that has it, under the same id.
struct MeshPart {
  std::vector<double> point_xyz{};       ///< Shape (num_points, 3); in length_unit.
  std::vector<GlobalIndex> point_ids{};  ///< Shape (num_points).

  std::vector<LocalIndex> tet_points{};      ///< Shape (num_tets, 4): rows of points; positive.
  std::vector<GlobalIndex> tet_ids{};        ///< Shape (num_tets).
  std::vector<std::int32_t> tet_material{};  ///< Shape (num_tets); material_names[m - 1].

  /// Shape (num_triangles, 3): rows of points; on the geometry, seen from outside.
  std::vector<LocalIndex> triangle_points{};
  std::vector<GlobalIndex> triangle_ids{};     ///< Shape (num_triangles).
  std::vector<LocalIndex> triangle_tet{};      ///< Shape (num_triangles): row of the tet behind.
  std::vector<std::int32_t> triangle_patch{};  ///< Shape (num_triangles); patch_names[p].

  std::vector<std::string> material_names{};
  std::vector<std::string> patch_names{};
  std::string length_unit{};  ///< E.g. "mm"; empty if nobody knows it.

  [[nodiscard]] LocalIndex num_points() const { return static_cast<LocalIndex>(point_ids.size()); }
  [[nodiscard]] LocalIndex num_tets() const { return static_cast<LocalIndex>(tet_ids.size()); }
  [[nodiscard]] LocalIndex num_triangles() const
  {
    return static_cast<LocalIndex>(triangle_ids.size());
  }
};

/// @brief A finished piece: what its files mesh/piece_NNNNNN.vtu and boundary/piece_NNNNNN.vtu
/// would hold.
struct MeshPiece : MeshPart {
  LocalIndex number = 0;                    ///< NNNNNN, from 0.
  std::vector<LocalIndex> point_owner{};    ///< Shape (num_points): subdomain that numbers it.
  std::vector<LocalIndex> tet_subdomain{};  ///< Shape (num_tets).
};

/// @brief A rank's share of a mesh whose every tet is on one rank. Ghosts, the copies of other
/// ranks' tets and the points that only these have, come last.
struct MeshShare : MeshPart {
  LocalIndex num_ghost_tets = 0;    ///< The last ones of num_tets().
  LocalIndex num_ghost_points = 0;  ///< The last ones of num_points().

  std::vector<Rank> tet_rank{};  ///< Shape (num_tets): who has it as its own.
  std::vector<Rank>
      point_owner{};  ///< Shape (num_points): lowest rank with a tet of its own there.
  /// Shape (num_points - num_ghost_points, …): the other ranks with tets of their own there,
  /// ascending.
  IndexLists point_sharers{};

  /// With ReadOptions::consecutive_points, shape (num_points): numbers from 0 such that those of
  /// the points that a rank owns follow each other, and those of the ranks below it. Else empty.
  std::vector<GlobalIndex> point_numbers{};
  GlobalIndex first_own_number = 0;  ///< The number of the first point that this rank owns.

  GlobalIndex num_global_points = 0;     ///< Of the whole mesh, as the next two.
  GlobalIndex num_global_tets = 0;       ///< Each counted on the rank that has it as its own.
  GlobalIndex num_global_triangles = 0;  ///< On the geometry.
  std::vector<std::string> notes{};      ///< What was not as a mesh of Tessera has it.
};

}  // namespace tessera::subdomain
