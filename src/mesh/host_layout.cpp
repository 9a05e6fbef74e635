// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/mesh/host_layout.hpp"

#include "tessera/mesh/lattice.hpp"

namespace tessera::mesh {

HostLayout::HostLayout(const Skeleton& skeleton)
    : HostLayout(skeleton.num_vertices(), skeleton.num_edges(), skeleton.num_triangles(),
                 skeleton.num_subdomains())
{
}

HostLayout::HostLayout(LocalIndex num_vertices, LocalIndex num_edges, LocalIndex num_triangles,
                       LocalIndex num_pieces)
    : first_{0, num_vertices, num_vertices + num_edges, num_vertices + num_edges + num_triangles,
             num_vertices + num_edges + num_triangles + num_pieces}
{
}

HostKind HostLayout::kind_of(HostEntity host) const
{
  std::size_t kind = 0;
  while (kind + 1 < kNumKinds && host >= first_[kind + 1]) ++kind;
  return static_cast<HostKind>(kind);
}

LocalIndex HostLayout::num_of(HostKind kind) const
{
  return first_[static_cast<std::size_t>(kind) + 1] - first(kind);
}

LocalIndex num_points_of_host(HostKind kind, LocalIndex n)
{
  if (kind == HostKind::vertex) return 1;
  return kind == HostKind::edge ? lattice::num_inner_edge_points(n)
                                : lattice::num_inner_triangle_points(n);
}

LocalIndex owner_of_host(const Skeleton& skeleton, const HostLayout& hosts, HostEntity host)
{
  const LocalIndex row = hosts.row_of(host);
  switch (hosts.kind_of(host)) {
    case HostKind::vertex:
      return skeleton.vertex_owner[at(row)];
    case HostKind::edge:
      return skeleton.edge_owner[at(row)];
    default:
      return skeleton.triangle_owner(row);
  }
}

}  // namespace tessera::mesh
