// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "check/match_triangles.hpp"
#include "check/match_vertices.hpp"
#include "check/piece_figures.hpp"
#include "check/piece_mesh.hpp"
#include "check/piece_topology.hpp"
#include "check/records.hpp"

namespace tessera::check {

/// @brief What a piece shows to the others, sent once.
struct ShownRecords {
  std::vector<TriangleRecord> triangles{};
  std::vector<VertexRecord> vertices{};
};

/// @brief What is kept of the surface of a piece while other pieces are read: the triangles with an
/// edge of which something is left to be said. It shrinks as the neighbours of the piece are read.
/// On the boundary of the mesh it stays until the end.
struct PieceSurface {
  PieceName name{};
  VertexIdentity identity = VertexIdentity::ids;
  std::vector<VertexRecord> vertices{};
  std::vector<std::array<LocalIndex, 3>> triangles{};  ///< Rows of vertices, outward order.
  std::vector<LocalIndex> rows{};   ///< As in the TriangleRecord of each triangle; ascending.
  std::vector<LocalIndex> cells{};  ///< Tet of each triangle.
  std::vector<std::int32_t> subdomains{};    ///< Of each triangle's tet.
  std::vector<TriangleRole> roles{};         ///< unknown until there is a verdict.
  std::vector<LocalIndex> partners{};        ///< Piece on the other side of each triangle.
  std::vector<std::uint8_t> closed_edges{};  ///< Bit i: the edge opposite to corner i.
  std::vector<LocalIndex> seam_points{};     ///< Points on seam triangles of this piece.

  [[nodiscard]] const Vec3& position(LocalIndex v) const
  {
    return vertices[static_cast<std::size_t>(v)].position;
  }
  [[nodiscard]] VertexKey key(LocalIndex v) const;
};

/// @brief Surface of a piece of tets. Local.
/// @param[in,out] shown Gets what other pieces must see.
/// @param[in,out] seam_keys Gets the vertices of seams inside the piece.
[[nodiscard]] PieceSurface make_surface(const PieceMesh& mesh, const PieceTopology& topology,
                                        ShownRecords& shown, std::vector<VertexKey>& seam_keys);

/// @brief Appends the triangles and points of a piece of the boundary file. Local.
void append_boundary(const PieceMesh& mesh, ShownRecords& shown);

/// @brief Notes what a triangle turned out to be. Local. @pre the surface still has it.
/// @param[in,out] seam_keys Gets the vertices of which it is new that they are on a seam.
void apply(const TriangleVerdict& verdict, PieceSurface& surface,
           std::vector<VertexKey>& seam_keys);

/// @brief Adds the areas of the triangles on the outside, in their order, to the records of their
/// subdomains. Local. @pre roles are known; each subdomain has its record.
void add_outside_areas(const PieceSurface& surface, PieceRecords& records);

/// @brief Drops triangles whose edges are closed and whose vertices are known to be on a seam, and
/// vertices without a triangle. Local.
void shrink(PieceSurface& surface);

}  // namespace tessera::check
