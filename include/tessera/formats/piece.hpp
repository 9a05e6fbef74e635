// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <tuple>
#include <vector>

#include "tessera/base/affine.hpp"
#include "tessera/base/box.hpp"
#include "tessera/base/index_lists.hpp"
#include "tessera/base/types.hpp"
#include "tessera/base/vec3.hpp"
#include "tessera/formats/shape.hpp"

/// What writers of file formats see of a mesh: what all ranks know of it, and its pieces one at a
/// time. Everything is numbered anew, by pieces: the points of a piece, and its elements of each
/// shape, have consecutive numbers that follow those of the pieces before it. So every piece has
/// its place in a file that all write, and the numbers are the same for any number of ranks.
namespace tessera::formats {

/// @brief So many cells with this tag.
struct TagCount {
  std::int32_t tag = 0;
  GlobalIndex count = 0;

  static auto fields(auto& self) { return std::tie(self.tag, self.count); }
};

/// @brief A piece that shares points with another one.
struct PieceNeighbour {
  LocalIndex piece = 0;
  GlobalIndex num_shared_points = 0;
  GlobalIndex num_shared_faces = 0;

  static auto fields(auto& self)
  {
    return std::tie(self.piece, self.num_shared_points, self.num_shared_faces);
  }
};

/// @brief Faces with this tag, of three corners or four, and the corners of all of them.
struct FaceCount {
  std::int32_t tag = 0;
  GlobalIndex num_faces = 0;
  GlobalIndex num_corners = 0;

  [[nodiscard]] GlobalIndex num_triangles() const { return 4 * num_faces - num_corners; }
  [[nodiscard]] GlobalIndex num_quads() const { return num_corners - 3 * num_faces; }

  static auto fields(auto& self) { return std::tie(self.tag, self.num_faces, self.num_corners); }
};

/// @brief Faces of the cells of a piece, where the sides of prisms are one face each.
struct CellFaceCounts {
  FaceCount inner{};                    ///< Between two cells of which the lower is in the piece.
  std::vector<FaceCount> of_patch{};    ///< On no second cell, by patch; none of zero.
  std::vector<TagCount> of_material{};  ///< Cells of each material; none of zero.

  static auto fields(auto& self) { return std::tie(self.inner, self.of_patch, self.of_material); }
};

/// @brief What is in one piece. Points are vertices, and of second order nodes on edges too.
struct PieceCounts {
  GlobalIndex num_own_points = 0;  ///< Those that no lower piece has.
  GlobalIndex num_own_nodes = 0;   ///< Those of them that are nodes on edges.
  GlobalIndex num_points = 0;
  GlobalIndex num_tets = 0;
  GlobalIndex num_cells = 0;  ///< Tets, but those of one prism are one cell.
  int points_per_tet = 0;     ///< 4, or 10 of second order; 0 if there are no tets.
  /// Cells of each material, faces of each patch, edges of each line: ascending; none of zero.
  ByShape<std::vector<TagCount>> elements{};
  /// Of triangles, also those that are half a face, without those that have a tet on the other side
  /// too.
  std::vector<TagCount> outer_triangles_of_patch{};
  std::vector<TagCount> points_of_patch{};   ///< Piece::patch_points; if asked for.
  GlobalIndex num_open_faces = 0;            ///< Of tets: with no tet on the other side anywhere.
  std::vector<PieceNeighbour> neighbours{};  ///< Ascending.
  Box box{};

  static auto fields(auto& self)
  {
    return std::tie(self.num_own_points, self.num_own_nodes, self.num_points, self.num_tets,
                    self.num_cells, self.points_per_tet, self.elements,
                    self.outer_triangles_of_patch, self.points_of_patch, self.num_open_faces,
                    self.neighbours, self.box);
  }
};

/// @brief Own points of a piece whose numbers follow one another.
struct PointRun {
  GlobalIndex first_number = 0;
  LocalIndex first_row = 0;
  LocalIndex count = 0;
};

/// @brief A patch whose points are the images of those of another one.
struct PeriodicPatch {
  std::int32_t from = 0;  ///< A tag of a patch.
  std::int32_t to = 0;    ///< Of its images.
  Affine there{};
  /// Shape (num_pieces + 1): so many points of Piece::periodic_points are in the pieces before.
  /// Only if these were asked for.
  std::vector<GlobalIndex> first_point{0};
};

/// @brief What all ranks know of a mesh; the same on each.
struct Outline {
  std::vector<PieceCounts> pieces{};
  std::vector<GlobalIndex> first_point{0};  ///< Shape (num_pieces + 1): of the own vertices.
  /// Shape (num_pieces + 1): of the own nodes on edges, which follow all vertices. Empty unless
  /// tets are of second order.
  std::vector<GlobalIndex> first_node{};
  std::vector<GlobalIndex> first_tet{0};   ///< Shape (num_pieces + 1); of prisms too.
  std::vector<GlobalIndex> first_cell{0};  ///< Shape (num_pieces + 1); in the order of their tets.
  /// Shape (num_pieces + 1) each: so many elements of a shape are in the pieces before.
  ByShape<std::vector<GlobalIndex>> first_of{{{{0}, {0}, {0}, {0}, {0}, {0}}}};
  /// Names of the tags 1, 2, …; none empty, none twice.
  std::vector<std::string> material_names{};
  std::vector<std::string> patch_names{};    ///< As material_names.
  std::vector<std::string> line_names{};     ///< The same.
  std::string length_unit{};                 ///< Empty if nobody knows it.
  std::vector<PeriodicPatch> periodic{};     ///< Empty unless asked for.
  std::vector<CellFaceCounts> cell_faces{};  ///< Shape (num_pieces); only for formats of polyhedra,
                                             ///< and if there are prisms.

  [[nodiscard]] LocalIndex num_pieces() const { return static_cast<LocalIndex>(pieces.size()); }
  [[nodiscard]] bool is_of_second_order() const { return !first_node.empty(); }
  [[nodiscard]] std::size_t points_per_tet() const { return is_of_second_order() ? 10 : 4; }
  [[nodiscard]] std::size_t points_per_triangle() const { return is_of_second_order() ? 6 : 3; }
  [[nodiscard]] GlobalIndex num_points() const
  {
    return is_of_second_order() ? first_node.back() : first_point.back();
  }
  [[nodiscard]] GlobalIndex num_tets() const { return first_tet.back(); }
  [[nodiscard]] GlobalIndex num_cells() const { return first_cell.back(); }
  [[nodiscard]] bool has_prisms() const { return num_cells() != num_tets(); }
  [[nodiscard]] GlobalIndex num_of(Shape shape) const { return first_of[shape].back(); }
  [[nodiscard]] GlobalIndex num_faces() const
  {
    return num_of(Shape::triangle) + num_of(Shape::quad);
  }
  [[nodiscard]] GlobalIndex num_elements() const { return num_cells() + num_faces(); }
  [[nodiscard]] GlobalIndex num_line_edges() const { return num_of(Shape::line); }

  /// @brief Number of the first element of a shape in a piece: elements have theirs from 0 in the
  /// order of shapes, those of one shape by pieces.
  [[nodiscard]] GlobalIndex first_number(Shape shape, LocalIndex piece) const
  {
    GlobalIndex number = first_of[shape][at(piece)];
    for (const Shape before : kAllShapes)
      if (before < shape) number += num_of(before);
    return number;
  }

  /// @brief Names of the tags that elements of a shape have.
  [[nodiscard]] const std::vector<std::string>& names_of(Shape shape) const
  {
    if (shape == Shape::line) return line_names;
    return is_cell(shape) ? material_names : patch_names;
  }

  /// @brief Points of an element: corners, and of second order nodes.
  [[nodiscard]] std::size_t points_per(Shape shape) const
  {
    if (!is_of_second_order()) return num_corners(shape);
    if (shape == Shape::line) return 3;
    return is_cell(shape) ? points_per_tet() : points_per_triangle();
  }

  /// @brief The own points of a piece, which are its first rows: vertices, then nodes on edges, of
  /// which there are none but of second order.
  [[nodiscard]] std::array<PointRun, 2> own_points(LocalIndex piece) const
  {
    const PieceCounts& counts = pieces[at(piece)];
    const auto num_nodes = static_cast<LocalIndex>(counts.num_own_nodes);
    const auto num_vertices = static_cast<LocalIndex>(counts.num_own_points) - num_nodes;
    const GlobalIndex node = is_of_second_order() ? first_node[at(piece)] : num_points();
    return {{{first_point[at(piece)], 0, num_vertices}, {node, num_vertices, num_nodes}}};
  }
};

/// @brief A face between a tet of this piece and one of another piece.
struct SeamFace {
  LocalIndex side = 0;  ///< 4 * tet + corner opposite to the face; tet is a row here.
  LocalIndex other_piece = 0;
  GlobalIndex other_tet = 0;   ///< Its number in the whole mesh, from 0.
  GlobalIndex other_cell = 0;  ///< The same of the cell that it is of.
  /// Its number among all faces between two tets, by the lower tet and then by the higher one, from
  /// 0; -1 unless asked for.
  GlobalIndex face_number = -1;
};

/// @brief A point that triangles of a patch have.
struct PatchPoint {
  LocalIndex point = 0;    ///< A row.
  std::int32_t patch = 0;  ///< A tag.
};

/// @brief A point of a patch that is the image of another one.
struct PeriodicPoint {
  std::int32_t patch = 0;     ///< A row of Outline::periodic.
  LocalIndex point = 0;       ///< A row.
  GlobalIndex of_number = 0;  ///< Number of the point whose image it is.
};

/// @brief A face of a periodic patch, which is an original or an image; both have one number.
struct CyclicFace {
  std::int32_t patch = 0;      ///< A tag.
  GlobalIndex number = 0;      ///< Of the original among those of its patch: triangles by pieces,
                               ///< then faces of four corners by pieces.
  LocalIndex row = 0;          ///< Among the faces of the patch in the piece.
  LocalIndex other_piece = 0;  ///< Whose the partner is; may be the piece itself.
  LocalIndex first_point = 0;  ///< A row: partners begin with points that are partners.
};

/// @brief Cells of other pieces that share a point with a piece, and those of their points that the
/// piece has not. Numbers are those of the whole mesh, from 0.
struct Ghosts {
  std::vector<GlobalIndex> cells{};      ///< Shape (num_ghosts): ascending, so shape by shape.
  std::vector<Shape> cell_shape{};       ///< Shape (num_ghosts).
  std::vector<LocalIndex> cell_piece{};  ///< Shape (num_ghosts): whose they are.
  Lists<GlobalIndex> cell_points{};      ///< Shape (num_ghosts, …): numbers; positive.
  std::vector<GlobalIndex> points{};     ///< Shape (num_ghost_points): ascending.
  std::vector<double> point_xyz{};       ///< Shape (num_ghost_points, 3).
};

/// @brief One piece. Rows are local, numbers are those of the whole mesh, from 0.
struct Piece {
  LocalIndex number = 0;  ///< Of the piece, from 0.

  /// Shape (num_points, 3). Own points come first, see Outline::own_points().
  std::vector<double> point_xyz{};
  std::vector<GlobalIndex> point_numbers{};  ///< Shape (num_points).
  LocalIndex num_own_points = 0;

  /// Shape (num_tets, 4), or (num_tets, 10) of second order: rows, in the order of VTK; positive.
  std::vector<LocalIndex> tet_points{};
  std::vector<std::int32_t> tet_material{};  ///< Shape (num_tets): tags from 1.
  /// Shape (num_tets): cell of the piece, from 0, ascending. Those of one prism are one cell.
  std::vector<LocalIndex> tet_cell{};

  /// Shape (num_triangles, 3), or (num_triangles, 6) of second order, with the nodes between 0 and
  /// 1, 1 and 2, 2 and 0: rows; each on the geometry, once in the mesh, seen from outside of its
  /// tet.
  std::vector<LocalIndex> triangle_points{};
  std::vector<LocalIndex> triangle_side{};  ///< Shape (num_triangles): 4 * tet + opposite corner.
  std::vector<std::int32_t> triangle_patch{};  ///< Shape (num_triangles): tags from 1.
  /// Shape (num_triangles): 1 if there is a tet on the other side too, here or in another piece.
  std::vector<std::uint8_t> is_inner_triangle{};

  /// Shape (num_line_edges, 2), or (num_line_edges, 3) of second order, with the node last: rows;
  /// each edge once in the mesh.
  std::vector<LocalIndex> line_points{};
  std::vector<std::int32_t> line{};  ///< Shape (num_line_edges): tags from 1.

  /// Ascending by patch, then by row. Of the pieces that have triangles of a patch on a point, the
  /// lowest has it here, which need not own it: so all pieces together have each point of a patch
  /// once. Empty unless asked for.
  std::vector<PatchPoint> patch_points{};

  /// Those of `patch_points` that are images, ascending by patch, then by row. Empty unless asked
  /// for.
  std::vector<PeriodicPoint> periodic_points{};

  /// Ascending by patch, then by number; only for formats of polyhedra. Empty unless asked for.
  std::vector<CyclicFace> cyclic_faces{};

  std::vector<LocalIndex> shared_points{};  ///< Rows of points that other pieces have; ascending.
  IndexLists sharers{};           ///< Shape (num_shared, …): those other pieces, ascending.
  std::vector<SeamFace> seams{};  ///< Ascending by side.
  Ghosts ghosts{};                ///< Only for writers that need them.

  /// Shape (num_shared_edges): points of edges that other pieces have; empty unless asked for.
  std::vector<std::array<LocalIndex, 2>> shared_edges{};
  IndexLists edge_sharers{};  ///< Shape (num_shared_edges, …): those other pieces, ascending.

  [[nodiscard]] LocalIndex num_points() const
  {
    return static_cast<LocalIndex>(point_numbers.size());
  }
  [[nodiscard]] LocalIndex num_tets() const { return static_cast<LocalIndex>(tet_material.size()); }
  [[nodiscard]] LocalIndex num_cells() const { return tet_cell.empty() ? 0 : tet_cell.back() + 1; }
  [[nodiscard]] LocalIndex num_triangles() const
  {
    return static_cast<LocalIndex>(triangle_patch.size());
  }
};

}  // namespace tessera::formats
