// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "tessera/base/types.hpp"

namespace tessera::mesh {

/// @brief Field text of files: names of the patches that have one body on both sides.
inline constexpr const char* kInsidePatchesName = "inside_patches";

/// @brief Arrays of one piece file as written or read; nothing is derived, nothing is trusted.
///
/// Plain exchange struct between the file format (io) and its users. Optional arrays are empty when
/// the file has none. Cells are all of one kind: tets (4 points; 10 of second order, in the order
/// of VTK_QUADRATIC_TETRA), triangles (3; 6 as VTK_QUADRATIC_TRIANGLE) or edges (2; 3 as
/// VTK_QUADRATIC_EDGE).
struct MeshArrays {
  int vertices_per_cell = 4;              ///< 4, 10: tets; 3, 6: boundary triangles.
  bool are_edges = false;                 ///< Then it is 2 or 3.
  std::vector<double> point_xyz{};        ///< Shape (num_points, 3).
  std::vector<LocalIndex> cell_points{};  ///< Shape (num_cells, vertices_per_cell), from 0.
  std::vector<GlobalIndex> point_ids{};   ///< Shape (num_points); GLOBAL_IDS. Optional.
  std::vector<GlobalIndex> cell_ids{};    ///< Shape (num_cells); GLOBAL_IDS. Optional.
  std::map<std::string, std::vector<std::int32_t>> point_ints{};  ///< E.g. "owner".
  std::map<std::string, std::vector<GlobalIndex>> point_longs{};  ///< E.g. "periodic_partner_1".
  std::map<std::string, std::vector<std::int32_t>> cell_ints{};   ///< E.g. "attribute", "patch".
  std::map<std::string, std::vector<GlobalIndex>>
      cell_longs{};                                           ///< E.g. "tet": id of the tet behind.
  std::map<std::string, std::vector<double>> cell_doubles{};  ///< E.g. "mean_ratio".
  std::map<std::string, std::vector<std::string>>
      field_texts{};                        ///< E.g. "patch_names", "length_unit".
  int num_ghost_layers = 0;                 ///< For a writer; a reader leaves ghosts out.
  std::vector<std::uint8_t> point_ghost{};  ///< Shape (num_points); 1: another piece owns it.
  std::vector<std::uint8_t> cell_ghost{};   ///< Shape (num_cells); 1: a copy of another piece's.
  GlobalIndex num_other_cells = 0;          ///< Cells of other kinds that a reader left out.

  [[nodiscard]] GlobalIndex num_points() const
  {
    return static_cast<GlobalIndex>(point_xyz.size() / 3);
  }
  [[nodiscard]] GlobalIndex num_cells() const
  {
    return static_cast<GlobalIndex>(cell_points.size()) / vertices_per_cell;
  }
};

}  // namespace tessera::mesh
