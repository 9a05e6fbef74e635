// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/mesh/triangle_grading.hpp"

#include <algorithm>

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

}  // namespace tessera::mesh
