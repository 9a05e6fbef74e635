// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>
#include <vector>

#include "tessera/base/index_lists.hpp"
#include "tessera/mesh/coarse_mesh.hpp"
#include "tessera/mesh/decomposition.hpp"
#include "tessera/mesh/skeleton.hpp"

namespace tessera::subdomain {

/// @brief The coarse mesh, cut into subdomains (both borrowed), with all that follows from the two;
/// every process that works on subdomains has one.
struct PartitionedMesh {
  const mesh::CoarseMesh& coarse;
  const mesh::Decomposition& decomposition;
  mesh::Skeleton skeleton;
  IndexLists tets;                  ///< mesh::subdomain_tets().
  std::vector<char> seam_hosts;     ///< mesh::hosts_on_seams().
  std::vector<char> on_geometry;    ///< untangle::vertices_on_geometry().
  std::vector<double> vertex_size;  ///< fill::vertex_sizes().

  /// @param[in] largest_size Bounds vertex_size, output length unit.
  PartitionedMesh(const mesh::CoarseMesh& coarse_mesh, const mesh::Decomposition& cut,
                  double largest_size = std::numeric_limits<double>::infinity());

  [[nodiscard]] LocalIndex num_subdomains() const { return decomposition.num_subdomains(); }
};

}  // namespace tessera::subdomain
