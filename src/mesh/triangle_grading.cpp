// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/mesh/triangle_grading.hpp"

#include <algorithm>
#include <bit>

namespace tessera::mesh {

TriangleGrading TriangleGrading::of(const std::array<EdgeRank, 3>& ranks,
                                    const std::array<int, 3>& levels)
{
  TriangleGrading grading;
  grading.level = *std::ranges::min_element(levels);
  for (std::size_t side = 0; side < levels.size(); ++side) {
    if (levels[side] > grading.level) grading.finer |= 1U << side;
    grading.order[side] = static_cast<std::uint8_t>(
        std::ranges::count_if(ranks, [&](const EdgeRank& other) { return other < ranks[side]; }));
  }
  return grading;
}

TriangleGrading triangle_grading(const Complex& complex, const RefinedLattice& lattice,
                                 LocalIndex t)
{
  std::array<EdgeRank, 3> ranks;
  std::array<int, 3> levels{};
  for (std::size_t side = 0; side < levels.size(); ++side) {
    const LocalIndex e = complex.triangle_edges[3 * at(t) + side];
    const LocalIndex* v = &complex.edge_vertices[2 * at(e)];
    ranks[side] = edge_rank({v[0], v[1]}, rank_positions(lattice, e));
    levels[side] = lattice.levels().edge(e);
  }
  return TriangleGrading::of(ranks, levels);
}

TriangleGrading triangle_grading(const Skeleton& skeleton, const CoarseMesh& coarse,
                                 const LatticeLevels& of_skeleton, LocalIndex t)
{
  std::array<EdgeRank, 3> ranks;
  std::array<int, 3> levels{};
  for (std::size_t side = 0; side < levels.size(); ++side) {
    const LocalIndex e = skeleton.triangle_edges[3 * at(t) + side];
    const LocalIndex a = skeleton.vertex_coarse[at(skeleton.edge_vertices[2 * at(e)])];
    const LocalIndex b = skeleton.vertex_coarse[at(skeleton.edge_vertices[2 * at(e) + 1])];
    ranks[side] = edge_rank({a, b}, {rank_position(coarse, a), rank_position(coarse, b)});
    levels[side] = of_skeleton.edge(e);
  }
  return TriangleGrading::of(ranks, levels);
}

// Inner corners and sides of the small triangles by Euler's formula.
LocalIndex num_inner_split_points(const TriangleGrading& grading, LocalIndex parts)
{
  const LocalIndex n = lattice::intervals(grading.level);
  const auto num_finer = static_cast<LocalIndex>(std::popcount(grading.finer));
  const LocalIndex num_triangles = n * n + num_finer * n;
  const LocalIndex num_outer_edges = 3 * n + num_finer * n;
  const LocalIndex num_inner_edges = (3 * num_triangles - num_outer_edges) / 2;
  return lattice::num_inner_triangle_points(n)
         + num_inner_edges * lattice::num_inner_edge_points(parts)
         + num_triangles * lattice::num_inner_triangle_points(parts);
}

SplitPointNumbers::SplitPointNumbers(const TriangleGrading& grading, LocalIndex parts)
    : n_(parts * grading.finest_intervals()),
      number_(at(lattice::num_inner_triangle_points(n_)), kNoIndex)
{
  using lattice::TrianglePoint;
  const auto mark = [&](const TrianglePoint& p) {
    const bool is_inside = p.i > 0 && p.j > 0 && p.i + p.j < n_;
    if (is_inside) number_[at(lattice::inner_triangle_index(n_, p.i, p.j))] = 0;
  };
  for_each_split_triangle(
      grading, parts, [&](const TrianglePoint& a, const TrianglePoint& b, const TrianglePoint& c) {
        mark(a);
        mark(b);
        mark(c);
      });
  LocalIndex next = 0;
  for (LocalIndex& number : number_) {
    if (number != kNoIndex) number = next++;
  }
}

}  // namespace tessera::mesh
