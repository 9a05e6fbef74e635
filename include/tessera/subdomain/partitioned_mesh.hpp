// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "tessera/base/index_lists.hpp"
#include "tessera/mesh/coarse_mesh.hpp"
#include "tessera/mesh/decomposition.hpp"
#include "tessera/mesh/edge_levels.hpp"
#include "tessera/mesh/skeleton.hpp"

namespace tessera::subdomain {

/// @brief The coarse mesh, cut into subdomains (both borrowed), and the levels on which these are
/// filled, with all that follows; every process that works on subdomains has one.
struct PartitionedMesh {
  const mesh::CoarseMesh& coarse;
  const mesh::Decomposition& decomposition;
  mesh::EdgeLevels levels;
  mesh::Skeleton skeleton;
  IndexLists tets;                  ///< mesh::subdomain_tets().
  std::vector<char> seam_hosts;     ///< mesh::hosts_on_seams().
  std::vector<char> on_geometry;    ///< untangle::vertices_on_geometry().
  std::vector<double> vertex_size;  ///< fill::vertex_sizes().

  PartitionedMesh(const mesh::CoarseMesh& coarse_mesh, const mesh::Decomposition& cut,
                  mesh::EdgeLevels edge_levels);

  [[nodiscard]] LocalIndex num_subdomains() const { return decomposition.num_subdomains(); }
};

}  // namespace tessera::subdomain
