// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <tuple>
#include <vector>

#include "tessera/base/flat_array.hpp"
#include "tessera/base/index_lists.hpp"
#include "tessera/mesh/coarse_mesh.hpp"
#include "tessera/mesh/decomposition.hpp"
#include "tessera/mesh/edge_levels.hpp"
#include "tessera/mesh/skeleton.hpp"

namespace tessera::subdomain {

/// @brief An edge of the skeleton on a line inside of solids. All of these are there: a line lies
/// on the sides of cells, and so between materials.
struct LineEdge {
  LocalIndex edge = kNoIndex;
  LocalIndex line = kNoIndex;   ///< Row of mesh::line_names().
  LocalIndex owner = kNoIndex;  ///< The lowest subdomain that ends there at another material or
                                ///< outside. Its tet at such a triangle stays its own, whatever the
                                ///< improvement of seams exchanges.

  static auto fields(auto& self) { return std::tie(self.edge, self.line, self.owner); }
};

/// @brief The levels on which subdomains are filled, and what follows from them, the coarse mesh
/// and the subdomains.
struct SubdomainTables {
  mesh::EdgeLevels levels{};
  mesh::Skeleton skeleton{};
  IndexLists tets{};                ///< mesh::subdomain_tets().
  FlatArray<char> seam_hosts{};     ///< mesh::hosts_on_seams().
  FlatArray<char> on_geometry{};    ///< untangle::vertices_on_geometry().
  FlatArray<double> vertex_size{};  ///< fill::vertex_sizes().
  std::vector<LineEdge> lines{};    ///< Ascending by edge.

  static auto fields(auto& self)
  {
    return std::tie(self.levels, self.skeleton, self.tets, self.seam_hosts, self.on_geometry,
                    self.vertex_size, self.lines);
  }
};

/// @brief Makes the tables. Local.
[[nodiscard]] SubdomainTables make_tables(const mesh::CoarseMesh& coarse,
                                          const mesh::Decomposition& decomposition,
                                          mesh::EdgeLevels levels);

/// @brief The coarse mesh, cut into subdomains (both borrowed), and their tables; every process
/// that works on subdomains has one.
struct PartitionedMesh : SubdomainTables {
  const mesh::CoarseMesh& coarse;
  const mesh::Decomposition& decomposition;

  PartitionedMesh(const mesh::CoarseMesh& coarse_mesh, const mesh::Decomposition& cut,
                  mesh::EdgeLevels edge_levels);

  /// @param[in] tables make_tables() of both.
  PartitionedMesh(const mesh::CoarseMesh& coarse_mesh, const mesh::Decomposition& cut,
                  SubdomainTables tables);

  [[nodiscard]] LocalIndex num_subdomains() const { return decomposition.num_subdomains(); }
};

}  // namespace tessera::subdomain
