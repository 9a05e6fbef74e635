// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "check/match/records.hpp"
#include "check/match/triangles.hpp"
#include "check/match/vertices.hpp"
#include "check/piece/figures.hpp"
#include "check/piece/mesh.hpp"
#include "check/piece/topology.hpp"

namespace tessera::check {

/// @brief A vertex on the surface of a piece.
struct SurfaceVertex {
  Vec3 position{};
  GlobalIndex id = kNoId;
  LocalIndex point = 0;  ///< Row in its piece.
  bool is_used = false;  ///< As in VertexRecord, as are the others.
  bool is_inner = false;
  bool is_on_seam = false;
  bool is_on_plus = false;
  bool is_on_minus = false;
};

/// @brief What tets of a piece have in common.
struct PieceRegion {
  LocalIndex component = 0;
  std::int32_t attribute = 0;
  std::int32_t subdomain = 0;
  bool has_cell_ids = false;
  std::uint64_t id_offset = 0;  ///< Id of a cell less its row, modulo 2^64: one if ids ascend.

  friend auto operator<=>(const PieceRegion&, const PieceRegion&) = default;
};

/// @brief What is kept of the surface of a piece while other pieces are read: the triangles with an
/// edge of which something is left to be said. It shrinks as the neighbours of the piece are read.
/// On the boundary of the mesh it stays until the end.
struct PieceSurface {
  PieceName name{};
  VertexIdentity identity = VertexIdentity::ids;
  std::vector<SurfaceVertex> vertices{};
  std::vector<PieceRegion> regions{};
  std::vector<std::array<LocalIndex, 3>> triangles{};  ///< Rows of vertices, outward order.
  std::vector<TriangleKey> keys{};     ///< Of each triangle; empty if its vertices say it.
  std::vector<LocalIndex> rows{};      ///< As in the TriangleSide of each triangle; ascending.
  std::vector<LocalIndex> cells{};     ///< Tet of each triangle.
  std::vector<LocalIndex> region{};    ///< Row of regions, of each triangle's tet; empty if there
                                       ///< was only one from the start.
  std::vector<TriangleRole> roles{};   ///< unknown until there is a verdict.
  std::vector<LocalIndex> partners{};  ///< Piece on the other side of each triangle.
  std::vector<std::uint8_t> closed_edges{};  ///< Bit i: the edge opposite to corner i.
  std::vector<LocalIndex> seam_points{};     ///< Points on seam triangles of this piece.

  [[nodiscard]] const Vec3& position(LocalIndex v) const
  {
    return vertices[static_cast<std::size_t>(v)].position;
  }
  [[nodiscard]] VertexKey key(LocalIndex v) const
  {
    const SurfaceVertex& vertex = vertices[static_cast<std::size_t>(v)];
    return identity == VertexIdentity::ids ? key_of_id(vertex.id)
                                           : key_of_position(vertex.position);
  }
  [[nodiscard]] const PieceRegion& region_of(std::size_t t) const
  {
    return region.empty() ? regions[0] : regions[static_cast<std::size_t>(region[t])];
  }

  [[nodiscard]] TriangleKey triangle_key(std::size_t t) const;
  /// @brief What decides about triangle t.
  [[nodiscard]] TriangleSide side(std::size_t t) const;
  /// @brief All that is said of triangle t.
  [[nodiscard]] TriangleRecord record(std::size_t t) const;
  /// @brief What other pieces must see of the vertices.
  [[nodiscard]] std::vector<VertexRecord> vertex_records() const;
};

/// @brief Surface of a piece of tets. Local.
/// @param[in,out] inner Gets both sides of the triangles on two tets that other pieces must see.
/// @param[in,out] seam_keys Gets the vertices of seams inside the piece.
[[nodiscard]] PieceSurface make_surface(const PieceMesh& mesh, const PieceTopology& topology,
                                        std::vector<TriangleRecord>& inner,
                                        std::vector<VertexKey>& seam_keys);

/// @brief Points of the triangles of a piece of the boundary file. Local.
[[nodiscard]] std::vector<VertexRecord> listed_vertices(const PieceMesh& mesh);

/// @brief Calls back with the triangles of a piece of the boundary file. Local.
void for_each_listed(const PieceMesh& mesh,
                     const std::function<void(const TriangleRecord&)>& visit);

/// @brief Which points of a piece are on its surface. Shape (num_points). Local. @pre It has not
/// shrunk.
[[nodiscard]] std::vector<bool> points_of_surface(const PieceMesh& mesh,
                                                  const PieceSurface& surface);

/// @brief Reports PieceMesh::equal_points that are not both on the surface: no split can be there.
/// Local. @pre as points_of_surface().
void report_equal_points_inside(const PieceMesh& mesh, const PieceSurface& surface,
                                Findings& findings);

/// @brief Notes what a triangle turned out to be. Local. @pre the surface still has it.
/// @param[in,out] seam_keys Gets the vertices of which it is new that they are on a seam.
void apply(const TriangleVerdict& verdict, PieceSurface& surface,
           std::vector<VertexKey>& seam_keys);

/// @brief Adds the areas of the triangles on the outside, in their order, to the records of their
/// subdomains. Local. @pre roles are known; each subdomain has its record.
void add_outside_areas(const PieceSurface& surface, PieceRecords& records);

/// @brief Drops triangles whose edges are closed and whose vertices are known to be on a seam, and
/// vertices and regions without a triangle. Local.
void shrink(PieceSurface& surface);

}  // namespace tessera::check
