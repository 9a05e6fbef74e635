// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <tuple>
#include <vector>

#include "tessera/base/quadratic_tet.hpp"
#include "tessera/base/types.hpp"
#include "tessera/base/vec3.hpp"
#include "tessera/mesh/host_layout.hpp"

namespace tessera::mesh {

/// @brief The points of layers over the vertices of a piece, by the names of these vertices.
struct Columns {
  std::vector<HostPoint> vertices{};  ///< Shape (num_columns), ascending.
  std::vector<double> point_xyz{};    ///< Shape (num_columns, most_layers, 3), towards the wall;
                                      ///< where layers are missing, the end of the column.
  // Of a piece that was split; else empty.
  std::vector<HostPoint> skin_names{};  ///< Shape (num_skin_vertices): what layers call them, for
                                        ///< the names that owners give say nothing of walls.
  std::vector<HostPoint> ends{};        ///< Shape (num_columns): where it ends at tets across a
                                        ///< joint, the name that their owner gives.

  static auto fields(auto& self)
  {
    return std::tie(self.vertices, self.point_xyz, self.skin_names, self.ends);
  }

  /// @brief The row of the column over a vertex; size() if there is none. O(log n).
  [[nodiscard]] std::size_t row_of(const HostPoint& vertex) const
  {
    const auto found = std::ranges::lower_bound(vertices, vertex);
    const bool is_there = found != vertices.end() && *found == vertex;
    return static_cast<std::size_t>((is_there ? found : vertices.end()) - vertices.begin());
  }

  [[nodiscard]] std::size_t size() const { return vertices.size(); }
};

/// @brief The tets of one subdomain, finished and immutable.
///
/// Vertices are numbered locally, those of the skin first. Global ids are not known before all
/// pieces are. So a skin vertex refers to (host, index), and interior vertex i to (the piece's own
/// host, i). Once seams were improved, "skin vertices" are those that several pieces may hold. A
/// vertex of the refined skeleton stays a skin vertex even if it now lies inside the piece. New
/// ones have hosts of their own (HostKind::seam_region).
struct Piece {
  LocalIndex subdomain = 0;
  LocalIndex material = 1;
  std::vector<double> vertex_xyz{};             ///< Shape (num_vertices, 3).
  std::vector<HostEntity> skin_host{};          ///< Shape (num_skin_vertices).
  std::vector<LocalIndex> skin_index{};         ///< Shape (num_skin_vertices).
  std::vector<LocalIndex> tet_vertices{};       ///< Shape (num_tets, 4); positive, VTK's order.
  std::vector<LocalIndex> boundary_vertices{};  ///< Shape (num_boundary, 3): triangles on the
                                                ///< geometry that this piece owns; outward.
  std::vector<LocalIndex> boundary_patch{};     ///< Shape (num_boundary).
  std::vector<LocalIndex> boundary_tet{};       ///< Shape (num_boundary); local tet behind it.
  std::vector<LocalIndex> line_vertices{};  ///< Shape (num_line_edges, 2): edges on lines inside
                                            ///< of solids that this piece owns.
  std::vector<LocalIndex> line{};           ///< Shape (num_line_edges): row of line_names().
  // Of a piece of second order; else empty. Nodes count as vertices.
  std::vector<LocalIndex> tet_edge_nodes{};       ///< Shape (num_tets, 6), kQuadraticTetEdges.
  std::vector<LocalIndex> boundary_edge_nodes{};  ///< Shape (num_boundary, 3): sides 01, 12, 20.
  std::vector<LocalIndex> line_nodes{};           ///< Shape (num_line_edges).
  Columns columns{};                              ///< Of its skin; empty without layers.

  static auto fields(auto& self)
  {
    return std::tie(self.subdomain, self.material, self.vertex_xyz, self.skin_host, self.skin_index,
                    self.tet_vertices, self.boundary_vertices, self.boundary_patch,
                    self.boundary_tet, self.line_vertices, self.line, self.tet_edge_nodes,
                    self.boundary_edge_nodes, self.line_nodes, self.columns);
  }

  [[nodiscard]] LocalIndex num_vertices() const { return count(vertex_xyz.size(), 3); }
  [[nodiscard]] LocalIndex num_skin_vertices() const { return count(skin_host.size(), 1); }
  [[nodiscard]] LocalIndex num_interior_vertices() const
  {
    return num_vertices() - num_skin_vertices();
  }
  /// @brief Name of skin vertex `v`.
  [[nodiscard]] HostPoint skin_point(LocalIndex v) const
  {
    return {skin_host[at(v)], skin_index[at(v)]};
  }
  /// @brief What layers call skin vertex `v`.
  [[nodiscard]] HostPoint name_in_layers(LocalIndex v) const
  {
    return columns.skin_names.empty() ? skin_point(v) : columns.skin_names[at(v)];
  }
  [[nodiscard]] LocalIndex num_tets() const { return count(tet_vertices.size(), 4); }
  [[nodiscard]] LocalIndex num_boundary() const { return count(boundary_patch.size(), 1); }

  [[nodiscard]] LocalIndex num_line_edges() const { return count(line.size(), 1); }

  [[nodiscard]] bool is_of_second_order() const { return !tet_edge_nodes.empty(); }

  /// @brief Corner positions of tet `t`.
  [[nodiscard]] std::array<Vec3, 4> corners(LocalIndex t) const
  {
    std::array<Vec3, 4> positions;
    for (std::size_t c = 0; c < 4; ++c) {
      positions[c] =
          point_at(std::span(vertex_xyz), tet_vertices[4 * static_cast<std::size_t>(t) + c]);
    }
    return positions;
  }

  /// @brief Positions of the nodes of tet `t`. @pre is_of_second_order()
  [[nodiscard]] QuadraticTet nodes(LocalIndex t) const
  {
    QuadraticTet positions;
    const auto tet = static_cast<std::size_t>(t);
    for (std::size_t c = 0; c < 4; ++c) {
      positions[c] = point_at(std::span(vertex_xyz), tet_vertices[4 * tet + c]);
    }
    for (std::size_t e = 0; e < 6; ++e) {
      positions[4 + e] = point_at(std::span(vertex_xyz), tet_edge_nodes[6 * tet + e]);
    }
    return positions;
  }

 private:
  static LocalIndex count(std::size_t size, std::size_t width)
  {
    return static_cast<LocalIndex>(size / width);
  }
};

}  // namespace tessera::mesh
