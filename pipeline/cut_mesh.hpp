// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>
#include <vector>

#include "tessera/mesh/coarse_mesh.hpp"
#include "tessera/mesh/decomposition.hpp"
#include "tessera/mesh/skeleton.hpp"
#include "tessera/mesh/subdomain_tets.hpp"

namespace tessera::pipeline {

/// @brief The coarse mesh, cut into subdomains (both borrowed), with all that follows from the two;
/// every process that works on subdomains has one.
struct CutMesh {
  const mesh::CoarseMesh& coarse;
  const mesh::Decomposition& decomposition;
  mesh::Skeleton skeleton;
  mesh::SubdomainTets tets;
  std::vector<char> seam_units;     ///< mesh::units_on_seams().
  std::vector<char> on_geometry;    ///< plan::vertices_on_geometry().
  std::vector<double> vertex_size;  ///< fill::vertex_sizes().

  /// @param[in] largest_size Bounds vertex_size, output length unit.
  CutMesh(const mesh::CoarseMesh& coarse_mesh, const mesh::Decomposition& cut,
          double largest_size = std::numeric_limits<double>::infinity());

  [[nodiscard]] LocalIndex num_subdomains() const { return decomposition.num_subdomains(); }
};

}  // namespace tessera::pipeline
