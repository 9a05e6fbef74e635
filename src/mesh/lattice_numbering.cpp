// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/mesh/lattice_numbering.hpp"

#include <vector>

#include "tessera/mesh/host_layout.hpp"

namespace tessera::mesh {

LatticeNumbering::LatticeNumbering(const Complex& complex, LocalIndex n)
    : complex_(complex),
      n_(n),
      vertex_(at(complex.num_vertices())),
      first_of_edge_(at(complex.num_edges())),
      first_of_triangle_(at(complex.num_triangles()))
{
  number(true);
  num_skeleton_points_ = num_points_;
  number(false);
}

void LatticeNumbering::number(bool on_skeleton)
{
  const auto give = [&](const std::vector<LocalIndex>& skeleton, HostKind kind,
                        std::vector<LocalIndex>& first) {
    const LocalIndex points_each = num_points_of_host(kind, n_);
    for (std::size_t i = 0; i < skeleton.size(); ++i) {
      if ((skeleton[i] != kNoIndex) != on_skeleton) continue;
      first[i] = num_points_;
      num_points_ += points_each;
    }
  };
  give(complex_.vertex_skeleton, HostKind::vertex, vertex_);
  give(complex_.edge_skeleton, HostKind::edge, first_of_edge_);
  give(complex_.triangle_skeleton, HostKind::triangle, first_of_triangle_);
}

LocalIndex LatticeNumbering::edge_point(LocalIndex e, LocalIndex k) const
{
  if (k == 0) return vertex(complex_.edge_vertices[2 * at(e)]);
  if (k == n_) return vertex(complex_.edge_vertices[2 * at(e) + 1]);
  return first_of_edge_[at(e)] + k - 1;
}

LocalIndex LatticeNumbering::triangle_point(LocalIndex t, const lattice::TrianglePoint& p) const
{
  const LocalIndex* edges = &complex_.triangle_edges[3 * at(t)];
  if (p.j == 0) return edge_point(edges[0], p.i);
  if (p.i == 0) return edge_point(edges[1], p.j);
  if (p.i + p.j == n_) return edge_point(edges[2], p.j);
  return first_of_triangle_[at(t)] + lattice::inner_triangle_index(n_, p.i, p.j);
}

}  // namespace tessera::mesh
