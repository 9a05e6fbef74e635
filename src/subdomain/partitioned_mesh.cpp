// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/subdomain/partitioned_mesh.hpp"

#include <utility>

#include "tessera/fill/size_samples.hpp"
#include "tessera/mesh/subdomain_tets.hpp"
#include "tessera/untangle/fold_test.hpp"

namespace tessera::subdomain {

PartitionedMesh::PartitionedMesh(const mesh::CoarseMesh& coarse_mesh,
                                 const mesh::Decomposition& cut, mesh::EdgeLevels edge_levels)
    : coarse(coarse_mesh),
      decomposition(cut),
      levels(std::move(edge_levels)),
      skeleton(mesh::build_skeleton(coarse, decomposition)),
      tets(mesh::subdomain_tets(decomposition)),
      seam_hosts(mesh::hosts_on_seams(skeleton, decomposition)),
      on_geometry(untangle::vertices_on_geometry(coarse, skeleton)),
      vertex_size(fill::vertex_sizes(coarse, levels))
{
}

}  // namespace tessera::subdomain
