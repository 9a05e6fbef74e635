// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/subdomain/partitioned_mesh.hpp"

#include <algorithm>

#include "tessera/fill/size_samples.hpp"
#include "tessera/mesh/subdomain_tets.hpp"
#include "tessera/untangle/fold_test.hpp"

namespace tessera::subdomain {

PartitionedMesh::PartitionedMesh(const mesh::CoarseMesh& coarse_mesh,
                                 const mesh::Decomposition& cut, double largest_size)
    : coarse(coarse_mesh),
      decomposition(cut),
      skeleton(mesh::build_skeleton(coarse, decomposition)),
      tets(mesh::subdomain_tets(decomposition)),
      seam_hosts(mesh::hosts_on_seams(skeleton, decomposition)),
      on_geometry(untangle::vertices_on_geometry(coarse, skeleton)),
      vertex_size(fill::vertex_sizes(coarse))
{
  for (double& size : vertex_size) size = std::min(size, largest_size);
}

}  // namespace tessera::subdomain
