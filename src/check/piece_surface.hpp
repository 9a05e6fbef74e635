// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "check/piece_figures.hpp"
#include "check/piece_mesh.hpp"
#include "check/piece_topology.hpp"
#include "check/records.hpp"

namespace tessera::check {

/// @brief What is kept of a piece while other pieces are read: what they may share with it.
struct PieceSurface {
  PieceName name{};
  Identity identity = Identity::kIds;
  std::vector<VertexRecord> vertices{};
  std::vector<std::array<LocalIndex, 3>> triangles{};  ///< Rows of vertices, outward order.
  std::vector<LocalIndex> cells{};                     ///< Tet of each triangle.
  std::vector<std::int32_t> subdomains{};              ///< Of each triangle's tet.
  std::vector<TriangleRole> roles{};  ///< Of each triangle; known after match_triangles.

  [[nodiscard]] const Vec3& position(LocalIndex v) const
  {
    return vertices[static_cast<std::size_t>(v)].position;
  }
  [[nodiscard]] VertexKey key(LocalIndex v) const;
};

/// @brief Surface of a piece of tets, and the records of its triangles. Local.
/// @param[in,out] records Gets one record per triangle of the surface, in the same order.
[[nodiscard]] PieceSurface make_surface(const PieceMesh& mesh, const PieceTopology& topology,
                                        std::vector<TriangleRecord>& records);

/// @brief The same of a piece of the boundary file.
[[nodiscard]] PieceSurface make_boundary_surface(const PieceMesh& mesh,
                                                 std::vector<TriangleRecord>& records);

/// @brief Marks the vertices of the triangles on seams, open or not. Local. @pre roles are set.
void mark_seam_vertices(PieceSurface& surface);

/// @brief Adds the areas of the triangles on the outside, in their order, to the records of their
/// subdomains. Local. @pre roles are set; each subdomain has its record.
void add_outside_areas(const PieceSurface& surface, PieceRecords& records);

struct SurfaceEdges {
  GlobalIndex num_edges = 0;               ///< Different ones.
  LocalIndex num_boundary_components = 0;  ///< Sets of boundary triangles joined through edges.
};

/// @brief Appends the edges of the surface. Local. @pre roles are set.
[[nodiscard]] SurfaceEdges append_edges(const PieceSurface& surface,
                                        std::vector<EdgeRecord>& records);

}  // namespace tessera::check
