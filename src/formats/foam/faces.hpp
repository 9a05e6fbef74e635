// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "tessera/formats/piece.hpp"

/// The faces of a piece in OpenFOAM's order. Cells are tets, or prisms of several tets; a face is a
/// side of a tet, or two of a prism, which are one face of four corners. It is seen from outside of
/// its owner.
namespace tessera::formats {

/// @brief A face of a cell.
struct FoamFace {
  std::array<LocalIndex, 4> points{};  ///< Rows, from the one with the lowest number on: so two
                                       ///< pieces begin with the same point.
  int num_points = 3;
  LocalIndex owner = 0;       ///< Cell of the piece.
  GlobalIndex neighbour = 0;  ///< Number of the other cell in the whole mesh, if there is
                              ///< one.
  LocalIndex side = 0;        ///< One of its sides: 4 * tet + opposite corner.

  [[nodiscard]] std::span<const LocalIndex> corners() const
  {
    return std::span(points).first(static_cast<std::size_t>(num_points));
  }
};

/// @brief Faces between two cells of which the lower one is in the piece, by owner and then by
/// neighbour; the neighbour may be in a later piece. Local; linear in time.
/// @param[in] first_cell Number of the piece's first cell in the whole mesh.
[[nodiscard]] std::vector<FoamFace> foam_inner_faces(const Piece& piece, GlobalIndex first_cell);

/// @brief Faces to another piece, in an order that both pieces find. Local.
[[nodiscard]] std::vector<FoamFace> foam_seam_faces(const Piece& piece, GlobalIndex first_cell,
                                                    LocalIndex other_piece);

/// @brief Faces of a patch with no second cell; of kNoPatchTag those that no triangle stands for.
/// Local.
[[nodiscard]] std::vector<FoamFace> foam_patch_faces(const Piece& piece, std::int32_t tag);
inline constexpr std::int32_t kNoPatchTag = 0;

/// @brief The faces of a periodic patch that are among `cyclic`, in the order of these, each from
/// its first point on. Local.
[[nodiscard]] std::vector<FoamFace> foam_cyclic_faces(const Piece& piece,
                                                      std::span<const CyclicFace> cyclic);

/// @brief Piece::cyclic_faces of a patch, by number. Local. Empty if it is none of a pair.
[[nodiscard]] std::span<const CyclicFace> cyclic_faces_of(const Piece& piece, std::int32_t tag);

/// @brief Cells of each material, as numbers. Local.
/// @param[in] first_cell Number of the piece's first cell.
[[nodiscard]] std::vector<std::vector<std::int32_t>> foam_zone_cells(const Piece& piece,
                                                                     std::size_t num_materials,
                                                                     GlobalIndex first_cell);

/// @brief What a piece with prisms has of faces and cells. Local.
/// @param[in] num_patches, num_materials Tags are 1, 2, … up to these.
[[nodiscard]] CellFaceCounts count_cell_faces(const Piece& piece, GlobalIndex first_cell,
                                              std::size_t num_patches, std::size_t num_materials);

}  // namespace tessera::formats
