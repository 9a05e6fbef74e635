// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "tessera/formats/piece.hpp"

namespace tessera::formats {

/// @brief Elements of one shape of a piece. Borrowed.
struct ElementList {
  std::size_t width = 0;                 ///< Points of an element.
  std::span<const LocalIndex> points{};  ///< Shape (num_elements, width): rows; see PieceCells.
  std::span<const std::int32_t> tags{};  ///< Shape (num_elements): materials, patches or lines.

  [[nodiscard]] std::size_t size() const { return tags.size(); }
  [[nodiscard]] std::span<const LocalIndex> of(std::size_t element) const
  {
    return points.subspan(width * element, width);
  }
};

/// @brief Numbers of the points of an element in the whole mesh, plus `first`. Local.
[[nodiscard]] std::vector<GlobalIndex> point_numbers(const Piece& piece, const ElementList& list,
                                                     GlobalIndex first = 0);

/// @brief The number that VTK has for a shape, of first order.
inline constexpr ByShape<std::uint8_t> kVtkTypes{{10, 14, 13, 5, 9, 3}};

/// @brief Appends the points of an element in VTK's order: the first triangle of its prisms is seen
/// from outside. Local.
template <class Index>
void append_vtk_points(Shape shape, std::span<const Index> points, std::vector<Index>& to)
{
  const std::size_t first = to.size();
  to.insert(to.end(), points.begin(), points.end());
  if (shape != Shape::prism) return;
  std::swap(to[first + 1], to[first + 2]);
  std::swap(to[first + 4], to[first + 5]);
}

/// @brief A cell, as a row of its shape.
struct CellPlace {
  Shape shape = Shape::tet;
  LocalIndex row = 0;
};

/// @brief A side of a cell. Of a tet `side` is the opposite corner. Of a prism 0, 1, 2 are the
/// sides of corners (0, 1), (1, 2), (2, 0), and 3 and 4 its triangles. Of a pyramid 0, 1, 2, 3 are
/// the triangles of corners (0, 1), (1, 2), (2, 3), (3, 0), and 4 is its base.
struct CellSide {
  CellPlace cell{};
  std::size_t side = 0;
};

/// @brief Cells, faces and edges on lines of a piece, as they are if tets of one prism are one
/// cell. Local.
///
/// Corners of a prism: a triangle, seen from the other one, and the corners above these. Of a
/// pyramid: its base, seen from its top, and the top. Of a face: seen from outside of its cell.
/// Formats have the same order but where they say so. Without prisms all is as in the piece.
class PieceCells {
 public:
  /// @param[in] piece Must outlive this.
  explicit PieceCells(const Piece& piece);
  PieceCells(const PieceCells&) = delete;
  PieceCells& operator=(const PieceCells&) = delete;

  [[nodiscard]] ElementList operator[](Shape shape) const;

  /// @brief The cell that a tet is of.
  [[nodiscard]] CellPlace cell_of(LocalIndex tet) const;

  /// @brief Of all faces, triangles before quads, the patch. Shape (num_faces).
  [[nodiscard]] std::vector<std::int32_t> patches() const;

  /// @brief What a face is of its cell. @param[in] face Row of patches().
  [[nodiscard]] CellSide side_of(std::size_t face) const;

  /// @brief A side of a tet that is the face, or half of it: 4 * tet + opposite corner.
  [[nodiscard]] LocalIndex tet_side(std::size_t face) const;

 private:
  void join_cells();
  void join_faces();

  const Piece& piece_;
  bool has_prisms_;
  ByShape<std::vector<LocalIndex>> points_{};  // None of these without prisms.
  ByShape<std::vector<std::int32_t>> tags_{};
  std::vector<LocalIndex> sides_{};  // Of faces: tet_side().
  std::vector<CellPlace> cell_of_tet_{};
};

}  // namespace tessera::formats
