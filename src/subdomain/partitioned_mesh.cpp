// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/subdomain/partitioned_mesh.hpp"

#include <utility>

#include "tessera/fill/size_samples.hpp"
#include "tessera/mesh/subdomain_tets.hpp"
#include "tessera/untangle/fold_test.hpp"

#include "subdomain/files/line_edges.hpp"

namespace tessera::subdomain {

SubdomainTables make_tables(const mesh::CoarseMesh& coarse,
                            const mesh::Decomposition& decomposition, mesh::EdgeLevels levels)
{
  SubdomainTables tables{.levels = std::move(levels),
                         .skeleton = mesh::build_skeleton(coarse, decomposition),
                         .tets = mesh::subdomain_tets(decomposition)};
  tables.seam_hosts = mesh::hosts_on_seams(tables.skeleton, decomposition);
  tables.on_geometry = untangle::vertices_on_geometry(coarse, tables.skeleton);
  tables.vertex_size = fill::vertex_sizes(coarse, tables.levels);
  tables.lines = edges_on_lines(coarse, tables.skeleton, decomposition);
  return tables;
}

PartitionedMesh::PartitionedMesh(const mesh::CoarseMesh& coarse_mesh,
                                 const mesh::Decomposition& cut, mesh::EdgeLevels edge_levels)
    : PartitionedMesh(coarse_mesh, cut, make_tables(coarse_mesh, cut, std::move(edge_levels)))
{
}

PartitionedMesh::PartitionedMesh(const mesh::CoarseMesh& coarse_mesh,
                                 const mesh::Decomposition& cut, SubdomainTables tables)
    : SubdomainTables(std::move(tables)), coarse(coarse_mesh), decomposition(cut)
{
}

}  // namespace tessera::subdomain
