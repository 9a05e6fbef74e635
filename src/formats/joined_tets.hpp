// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "tessera/formats/piece.hpp"

#include "formats/piece_source.hpp"

/// Prisms stand in piece files as tets. Three tets that follow one another are a prism, two a
/// pyramid, as layers::append_prism_tets() makes them.
namespace tessera::formats {

/// @brief Tets, and which of them are one cell. Borrowed.
struct JoinedTets {
  std::span<const LocalIndex> points{};  ///< Shape (num_tets, 4).
  std::span<const LocalIndex> cell{};    ///< Shape (num_tets): as Piece::tet_cell.

  explicit JoinedTets(const Piece& piece) : points(piece.tet_points), cell(piece.tet_cell) {}
  explicit JoinedTets(const LoadedPiece& piece) : points(piece.tet_points), cell(piece.tet_cell) {}

  [[nodiscard]] LocalIndex num_tets() const { return static_cast<LocalIndex>(cell.size()); }
  [[nodiscard]] bool has_prisms() const { return !cell.empty() && cell.back() + 1 != num_tets(); }
  [[nodiscard]] std::span<const LocalIndex> corners(LocalIndex tet) const
  {
    return points.subspan(4 * at(tet), 4);
  }
};

/// @brief The tets of one cell.
struct CellTets {
  LocalIndex first = 0;
  LocalIndex count = 0;

  [[nodiscard]] Shape shape() const
  {
    return std::array{Shape::tet, Shape::pyramid, Shape::prism}[at(count - 1)];
  }
};

/// @brief Those of the cell that a tet is of. Local.
[[nodiscard]] CellTets tets_of_cell(const JoinedTets& tets, LocalIndex tet);

/// @brief Corners of a cell that is no tet. Local. Of a prism a triangle, seen from the other one,
/// and the corners above these; of a pyramid its base, seen from its top, and the top.
[[nodiscard]] std::array<LocalIndex, 6> prism_corners(const JoinedTets& tets, LocalIndex first);
[[nodiscard]] std::array<LocalIndex, 5> pyramid_corners(const JoinedTets& tets, LocalIndex first);

/// @brief What is wrong with the tets of a cell, or empty. Local.
[[nodiscard]] const char* defect_of_cell(const JoinedTets& tets, const CellTets& cell);

/// @brief The other half of a side of four corners; kNoIndex if the side is a triangle. Local.
/// @param[in] side 4 * tet + opposite corner.
[[nodiscard]] LocalIndex other_half(const JoinedTets& tets, LocalIndex side);

/// @brief A side of a cell: rows of a list of sides of tets.
struct JoinedSide {
  LocalIndex row = 0;
  LocalIndex other_row = kNoIndex;  ///< Of the other half, whose side is higher.

  [[nodiscard]] Shape shape() const
  {
    return other_row == kNoIndex ? Shape::triangle : Shape::quad;
  }
};

/// @brief Joins the sides of tets that are one side of a cell. Local.
/// @param[in] sides None twice.
/// @return In the order of the list, the two halves where the lower of them stands.
[[nodiscard]] std::vector<JoinedSide> joined_sides(const JoinedTets& tets,
                                                   std::span<const LocalIndex> sides);

/// @brief Corners of a side of a cell, seen from outside. Local.
[[nodiscard]] std::vector<LocalIndex> corners_of(const JoinedTets& tets,
                                                 std::span<const LocalIndex> sides,
                                                 const JoinedSide& side);

/// @brief Corners of the side of a tet, seen from outside. Local.
[[nodiscard]] std::array<LocalIndex, 3> triangle_of_side(const JoinedTets& tets, LocalIndex side);

/// @brief Corners of two triangles with a common edge, seen from where both are. Local.
[[nodiscard]] std::array<LocalIndex, 4> quad_of(const std::array<LocalIndex, 3>& a,
                                                const std::array<LocalIndex, 3>& b);

}  // namespace tessera::formats
