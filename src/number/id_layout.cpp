// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/number/id_layout.hpp"

#include <utility>

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
    first_line_edge_.push_back(first_line_edge_.back() + piece.line_edges);
  }
}

IdLayout IdLayout::by_host(const mesh::HostLayout& hosts, const mesh::LatticeLevels& levels,
                           const std::vector<PieceCounts>& pieces)
{
  std::vector<GlobalIndex> first;
  first.reserve(at(hosts.num_on_skeleton()));
  GlobalIndex next = 0;
  const auto give = [&](GlobalIndex num_points) {
    first.push_back(next);
    next += num_points;
  };
  for (LocalIndex v = 0; v < hosts.num_of(HostKind::vertex); ++v) give(1);
  for (const std::int8_t level : levels.edges) {
    give(mesh::num_points_of_host(HostKind::edge, mesh::lattice::intervals(level)));
  }
  for (const std::int8_t level : levels.triangles) {
    give(mesh::num_points_of_host(HostKind::triangle, mesh::lattice::intervals(level)));
  }
  IdLayout ids(next, pieces, &PieceCounts::interior_vertices);
  ids.skeleton_.emplace(SkeletonIds{hosts, std::move(first)});
  return ids;
}

IdLayout IdLayout::by_owner(const std::vector<PieceCounts>& pieces)
{
  return {0, pieces, &PieceCounts::owned_vertices};
}

GlobalIndex IdLayout::vertex_id(const mesh::HostPoint& vertex) const
{
  const SkeletonIds& skeleton = *skeleton_;
  if (vertex.host < skeleton.hosts.num_on_skeleton()) {
    return skeleton.first[at(vertex.host)] + vertex.index;
  }
  return interior_vertex_id(skeleton.hosts.row_of(vertex.host), vertex.index);
}

}  // namespace tessera::number
