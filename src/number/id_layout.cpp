// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/number/id_layout.hpp"

namespace tessera::number {

using mesh::HostKind;

IdLayout::IdLayout(GlobalIndex num_skeleton_vertices, const std::vector<PieceCounts>& pieces,
                   GlobalIndex PieceCounts::*num_vertices)
    : first_vertex_{num_skeleton_vertices}
{
  for (const PieceCounts& piece : pieces) {
    first_vertex_.push_back(first_vertex_.back() + piece.*num_vertices);
    first_tet_.push_back(first_tet_.back() + piece.tets);
    first_boundary_triangle_.push_back(first_boundary_triangle_.back() + piece.boundary_triangles);
  }
}

IdLayout IdLayout::by_host(const mesh::HostLayout& hosts, LocalIndex n,
                           const std::vector<PieceCounts>& pieces)
{
  IdLayout ids(hosts.num_skeleton_points(n), pieces, &PieceCounts::interior_vertices);
  SkeletonIds& skeleton = ids.skeleton_.emplace(SkeletonIds{.hosts = hosts});
  skeleton.points_of_edge = mesh::num_points_of_host(HostKind::edge, n);
  skeleton.points_of_triangle = mesh::num_points_of_host(HostKind::triangle, n);
  skeleton.first_of_edges = hosts.num_of(HostKind::vertex);
  skeleton.first_of_triangles =
      skeleton.first_of_edges + skeleton.points_of_edge * hosts.num_of(HostKind::edge);
  return ids;
}

IdLayout IdLayout::by_owner(const std::vector<PieceCounts>& pieces)
{
  return {0, pieces, &PieceCounts::owned_vertices};
}

GlobalIndex IdLayout::vertex_id(const mesh::HostPoint& vertex) const
{
  const SkeletonIds& skeleton = *skeleton_;
  const LocalIndex row = skeleton.hosts.row_of(vertex.host);
  switch (skeleton.hosts.kind_of(vertex.host)) {
    case HostKind::vertex:
      return row;
    case HostKind::edge:
      return skeleton.first_of_edges + skeleton.points_of_edge * row + vertex.index;
    case HostKind::triangle:
      return skeleton.first_of_triangles + skeleton.points_of_triangle * row + vertex.index;
    default:
      return interior_vertex_id(row, vertex.index);
  }
}

}  // namespace tessera::number
