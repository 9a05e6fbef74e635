// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <span>
#include <tuple>
#include <vector>

#include "tessera/base/flat_array.hpp"
#include "tessera/base/index_lists.hpp"
#include "tessera/base/types.hpp"
#include "tessera/mesh/coarse_mesh.hpp"
#include "tessera/mesh/decomposition.hpp"
#include "tessera/mesh/orbits.hpp"

namespace tessera::mesh {

/// @brief The coarse triangles on the geometry or between two subdomains, with their edges and
/// vertices: all that subdomains share. A pure function of coarse mesh and decomposition, so every
/// process builds the same one for itself.
///
/// Triangles and edges list their vertices in ascending order of coarse vertex numbers. Each edge
/// carries one *canonical record* that says where its new points lie. They lie on its curve if it
/// has one, else on the surface of its lowest triangle on the geometry. Without either they are
/// plain midpoints.
struct Skeleton {
  FlatArray<LocalIndex> vertex_coarse{};  ///< Shape (num_vertices); coarse vertex, ascending.
  FlatArray<LocalIndex> vertex_owner{};   ///< Lowest subdomain that holds the vertex.

  FlatArray<LocalIndex> edge_vertices{};  ///< Shape (num_edges, 2); rows of vertex_coarse.
  FlatArray<LocalIndex> edge_owner{};     ///< Lowest subdomain that holds the edge.
  FlatArray<LocalIndex> edge_curve{};     ///< The Model's curve, or kNoIndex.
  FlatArray<LocalIndex> edge_patch{};     ///< Patch of its lowest triangle on the geometry, or
                                          ///< kNoIndex. Counts where there is no curve.
  /// Shape (num_edges, 2, 2). Parameters of the ends on what counts: (t, 0) or (u, v).
  FlatArray<double> edge_parameters{};

  /// Shape (num_edges), or empty without layers: whether an edge is a side of a wall's triangle.
  /// Such an edge is refined on the wall, and its record is the wall's.
  FlatArray<char> edge_on_wall{};
  /// Shape (num_edges), or empty without layers: the patch without layers that columns along a
  /// wall's edge lie on, or kNoIndex; and the parameters of the ends there, shape (num_edges, 2,
  /// 2).
  FlatArray<LocalIndex> edge_side_patch{};
  FlatArray<double> edge_side_uv{};
  /// Shape (num_vertices), or empty without layers: the edge that says along what the column of a
  /// vertex at the rim of a wall goes. It is off the walls, and has the curve; or on one, and has
  /// the side patch; or kNoIndex.
  FlatArray<LocalIndex> vertex_side_edge{};

  FlatArray<LocalIndex> triangle_vertices{};  ///< Shape (num_triangles, 3); rows of vertex_coarse.
  FlatArray<LocalIndex> triangle_edges{};     ///< Shape (num_triangles, 3); sides 01, 02, 12.
  FlatArray<LocalIndex> triangle_patch{};     ///< Patch, or kNoIndex off the geometry.
  FlatArray<double> triangle_uv{};            ///< Shape (num_triangles, 3, 2), corner parameters.
  /// Shape (num_triangles, 2). Entry 0: the subdomain that the ascending orientation points out of;
  /// entry 1: the one it points into. kNoIndex: outside.
  FlatArray<LocalIndex> triangle_subdomains{};

  IndexLists subdomain_triangles{};  ///< Triangles of each subdomain, ascending.

  Orbits orbits{};  ///< What is the image of what; empty: nothing.

  static auto fields(auto& self)
  {
    return std::tie(self.vertex_coarse, self.vertex_owner, self.edge_vertices, self.edge_owner,
                    self.edge_curve, self.edge_patch, self.edge_parameters, self.edge_on_wall,
                    self.edge_side_patch, self.edge_side_uv, self.vertex_side_edge,
                    self.triangle_vertices, self.triangle_edges, self.triangle_patch,
                    self.triangle_uv, self.triangle_subdomains, self.subdomain_triangles,
                    self.orbits);
  }

  [[nodiscard]] LocalIndex num_vertices() const { return size_of(vertex_coarse); }
  [[nodiscard]] LocalIndex num_edges() const { return size_of(edge_owner); }
  [[nodiscard]] LocalIndex num_triangles() const { return size_of(triangle_patch); }
  [[nodiscard]] LocalIndex num_subdomains() const { return subdomain_triangles.num_lists(); }

  /// @brief Triangles of one subdomain's skin.
  [[nodiscard]] std::span<const LocalIndex> triangles_of(LocalIndex subdomain) const
  {
    return subdomain_triangles[subdomain];
  }

  /// @brief Lowest subdomain beside triangle `t`.
  [[nodiscard]] LocalIndex triangle_owner(LocalIndex t) const;

  /// @brief Whether both sides of triangle `t` are subdomains (of one or of two materials).
  [[nodiscard]] bool is_inside(LocalIndex t) const;

  /// @brief Whether edge `e` is a side of a wall's triangle.
  [[nodiscard]] bool is_on_wall(LocalIndex e) const
  {
    return !edge_on_wall.empty() && edge_on_wall[at(e)] != 0;
  }

 private:
  template <class T>
  static LocalIndex size_of(const FlatArray<T>& array)
  {
    return static_cast<LocalIndex>(array.size());
  }
};

/// @brief Builds the skeleton. Local; O(n log n) in the coarse tets.
/// @pre validate(coarse) holds and the decomposition belongs to that mesh.
[[nodiscard]] Skeleton build_skeleton(const CoarseMesh& coarse, const Decomposition& decomposition);

/// @brief Which hosts of the skeleton lie between two subdomains of one material. Tets that touch
/// one are *seam tets*. Shape (HostLayout::num_on_skeleton()). Local.
[[nodiscard]] std::vector<char> hosts_on_seams(const Skeleton& skeleton,
                                               const Decomposition& decomposition);

/// @brief For each subdomain the others that share a vertex of the skeleton with it, ascending.
/// Local.
[[nodiscard]] std::vector<std::vector<LocalIndex>> neighbours_by_vertex(const Skeleton& skeleton);

}  // namespace tessera::mesh
