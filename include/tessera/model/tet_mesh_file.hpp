// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "tessera/base/types.hpp"

namespace tessera::model {

/// @brief Cells of one kind as a mesh file has them.
struct FileCells {
  std::vector<LocalIndex> points{};    ///< Shape (num_cells, 3 or 4); rows of the file's points.
  std::vector<GlobalIndex> number{};   ///< Shape (num_cells); what the file calls the cell.
  std::vector<std::int32_t> group{};   ///< Shape (num_cells); what users tag, 0: nothing.
  std::vector<std::int32_t> entity{};  ///< Shape (num_cells); the geometric entity, 0: unknown.

  [[nodiscard]] std::size_t size() const { return number.size(); }
};

/// @brief A tet mesh as a file has it. Points and indices are checked, and nothing else is.
struct TetMeshFile {
  std::vector<double> point_xyz{};          ///< Shape (num_points, 3), finite; file length unit.
  std::vector<GlobalIndex> point_number{};  ///< Shape (num_points); what the file calls the point.
  FileCells tets{};
  FileCells triangles{};
  std::map<std::int32_t, std::string> tet_group_names{};
  std::map<std::int32_t, std::string> triangle_group_names{};
};

/// @brief Reads a mesh file of Gmsh, MSH 2.2 or 4.1, ASCII or binary. Local.
///
/// Groups are the physical groups, entities the elementary tags. Points and lines are passed over.
/// No number in the file is trusted for an allocation. The reader is our own: Gmsh's is GPL.
/// @throws InputError naming the file and the line (ASCII) or byte (binary): missing, truncated,
/// another format or version, an index out of range, a coordinate that is not a finite number,
/// cells that are no linear tets and triangles (says what to do).
[[nodiscard]] TetMeshFile read_msh(const std::filesystem::path& file);

/// @brief Reads a mesh file of NETGEN, `.vol`. Local.
///
/// Groups of triangles are the boundary conditions, entities the surfaces; groups of tets are the
/// domains.
/// @throws InputError as read_msh().
[[nodiscard]] TetMeshFile read_vol(const std::filesystem::path& file);

}  // namespace tessera::model
