// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <string_view>
#include <utility>

#include "tessera/mesh/mesh_arrays.hpp"

namespace tessera::io {

inline constexpr const char* kPointIdsName = "GlobalPointIds";
inline constexpr const char* kCellIdsName = "GlobalCellIds";

/// Names that tools give to global ids without flagging them; our own come first.
inline constexpr std::array<std::string_view, 6> kUsualPointIdNames{
    kPointIdsName,   "GlobalNodeID",  "GlobalNodeId",
    "GlobalPointID", "GlobalNodeIds", "vtkGlobalPointIds"};
inline constexpr std::array<std::string_view, 6> kUsualCellIdNames{
    kCellIdsName,   "GlobalElementID",  "GlobalElementId",
    "GlobalCellID", "GlobalElementIds", "vtkGlobalCellIds"};

/// @brief Whether the piece has point ids. An empty one always has, as an index of pieces with ids
/// demands them of every piece.
[[nodiscard]] inline bool has_point_ids(const mesh::MeshArrays& piece)
{
  return std::cmp_equal(piece.point_ids.size(), piece.num_points());
}

/// @brief Whether the piece has cell ids; see has_point_ids.
[[nodiscard]] inline bool has_cell_ids(const mesh::MeshArrays& piece)
{
  return std::cmp_equal(piece.cell_ids.size(), piece.num_cells());
}

}  // namespace tessera::io
