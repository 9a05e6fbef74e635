// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/mesh/lattice_numbering.hpp"

#include <vector>

namespace tessera::mesh {

LatticeNumbering::LatticeNumbering(const Complex& complex, const LatticeLevels& levels)
    : complex_(complex),
      levels_(levels),
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
  const auto give = [&](const std::vector<LocalIndex>& skeleton, std::vector<LocalIndex>& first,
                        auto&& num_points_of) {
    for (std::size_t i = 0; i < skeleton.size(); ++i) {
      if ((skeleton[i] != kNoIndex) != on_skeleton) continue;
      first[i] = num_points_;
      num_points_ += num_points_of(static_cast<LocalIndex>(i));
    }
  };
  give(complex_.vertex_skeleton, vertex_, [](LocalIndex /*v*/) { return 1; });
  give(complex_.edge_skeleton, first_of_edge_,
       [&](LocalIndex e) { return lattice::num_inner_edge_points(levels_.edge_intervals(e)); });
  give(complex_.triangle_skeleton, first_of_triangle_, [&](LocalIndex t) {
    return lattice::num_inner_triangle_points(levels_.triangle_intervals(t));
  });
}

LocalIndex LatticeNumbering::edge_point(LocalIndex e, LocalIndex k) const
{
  if (k == 0) return vertex(complex_.edge_vertices[2 * at(e)]);
  if (k == levels_.edge_intervals(e)) return vertex(complex_.edge_vertices[2 * at(e) + 1]);
  return first_of_edge_[at(e)] + k - 1;
}

// Point k of a side with n intervals; the edge may be finer or coarser.
LocalIndex LatticeNumbering::side_point(LocalIndex e, LocalIndex n, LocalIndex k) const
{
  const LocalIndex own = levels_.edge_intervals(e);
  return edge_point(e, own < n ? k / (n / own) : k * (own / n));
}

LocalIndex LatticeNumbering::triangle_point(LocalIndex t, LocalIndex n,
                                            const lattice::TrianglePoint& p) const
{
  const LocalIndex* edges = &complex_.triangle_edges[3 * at(t)];
  if (p.j == 0) return side_point(edges[0], n, p.i);
  if (p.i == 0) return side_point(edges[1], n, p.j);
  if (p.i + p.j == n) return side_point(edges[2], n, p.j);
  const LocalIndex own = levels_.triangle_intervals(t);
  const LocalIndex step = n / own;
  return first_of_triangle_[at(t)] + lattice::inner_triangle_index(own, p.i / step, p.j / step);
}

}  // namespace tessera::mesh
