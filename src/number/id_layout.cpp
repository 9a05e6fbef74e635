// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/number/id_layout.hpp"

#include "tessera/mesh/lattice.hpp"

namespace tessera::number {

IdLayout::IdLayout(const mesh::HostLayout& hosts, LocalIndex n,
                   const std::vector<PieceCounts>& pieces)
    : hosts_(hosts),
      edge_points_(mesh::lattice::num_inner_edge_points(n)),
      triangle_points_(mesh::lattice::num_inner_triangle_points(n)),
      first_triangle_id_(hosts.first_edge
                         + edge_points_ * (hosts.first_triangle - hosts.first_edge))
{
  const GlobalIndex skeleton_vertices =
      first_triangle_id_ + triangle_points_ * (hosts.first_piece - hosts.first_triangle);
  interior_offset_.push_back(skeleton_vertices);
  tet_offset_.push_back(0);
  boundary_offset_.push_back(0);
  for (const PieceCounts& piece : pieces) {
    interior_offset_.push_back(interior_offset_.back() + piece.interior_vertices);
    tet_offset_.push_back(tet_offset_.back() + piece.tets);
    boundary_offset_.push_back(boundary_offset_.back() + piece.boundary_triangles);
  }
}

GlobalIndex IdLayout::vertex_id(mesh::HostEntity host, LocalIndex index) const
{
  if (host < hosts_.first_edge) return host;
  if (host < hosts_.first_triangle) {
    return hosts_.first_edge + edge_points_ * (host - hosts_.first_edge) + index;
  }
  if (host < hosts_.first_piece) {
    return first_triangle_id_ + triangle_points_ * (host - hosts_.first_triangle) + index;
  }
  return interior_vertex_id(host - hosts_.first_piece, index);
}

}  // namespace tessera::number
