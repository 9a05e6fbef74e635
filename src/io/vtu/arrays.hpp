// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
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

/// @brief A kind of cells by its points.
struct CellKind {
  int vertices = 4;
  bool is_edge = false;
};

/// @brief VTK's number of a kind of cells: tets, triangles and edges of first and second order; 0
/// for another number of points.
[[nodiscard]] constexpr std::uint8_t vtk_cell_type(const CellKind& kind)
{
  if (kind.is_edge) return kind.vertices == 2 ? 3 : kind.vertices == 3 ? 21 : 0;
  switch (kind.vertices) {
    case 3:
      return 5;
    case 4:
      return 10;
    case 6:
      return 22;
    case 10:
      return 24;
    default:
      return 0;
  }
}

[[nodiscard]] inline std::uint8_t vtk_cell_type(const mesh::MeshArrays& piece)
{
  return vtk_cell_type(CellKind{piece.vertices_per_cell, piece.are_edges});
}

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
