// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/mesh/lattice_levels.hpp"

#include <algorithm>

namespace tessera::mesh {
namespace {

// Complex and Skeleton name their arrays alike.
template <class Entities>
LatticeLevels levels_of(const Entities& entities, const EdgeLevels& levels)
{
  LatticeLevels result;
  const auto coarse = [&](LocalIndex v) { return entities.vertex_coarse[at(v)]; };
  for (LocalIndex e = 0; e < entities.num_edges(); ++e) {
    const LocalIndex* v = &entities.edge_vertices[2 * at(e)];
    result.edges.push_back(static_cast<std::int8_t>(levels.of(coarse(v[0]), coarse(v[1]))));
  }
  for (LocalIndex t = 0; t < entities.num_triangles(); ++t) {
    const LocalIndex* sides = &entities.triangle_edges[3 * at(t)];
    result.triangles.push_back(std::min(
        {result.edges[at(sides[0])], result.edges[at(sides[1])], result.edges[at(sides[2])]}));
  }
  return result;
}

}  // namespace

int LatticeLevels::largest() const { return edges.empty() ? 0 : *std::ranges::max_element(edges); }

LatticeLevels lattice_levels(const Complex& complex, const EdgeLevels& levels)
{
  return levels_of(complex, levels);
}

LatticeLevels lattice_levels(const Skeleton& skeleton, const EdgeLevels& levels)
{
  return levels_of(skeleton, levels);
}

GlobalIndex num_skeleton_points(const Skeleton& skeleton, const LatticeLevels& levels)
{
  GlobalIndex sum = skeleton.num_vertices();
  for (const std::int8_t level : levels.edges) {
    sum += lattice::num_inner_edge_points(lattice::intervals(level));
  }
  for (const std::int8_t level : levels.triangles) {
    sum += lattice::num_inner_triangle_points(lattice::intervals(level));
  }
  return sum;
}

GlobalIndex num_small_triangles(const Skeleton& skeleton, const LatticeLevels& levels,
                                LocalIndex triangle)
{
  const GlobalIndex n = levels.triangle_intervals(triangle);
  GlobalIndex count = n * n;
  for (std::size_t side = 0; side < 3; ++side) {
    count += levels.edge_intervals(skeleton.triangle_edges[3 * at(triangle) + side]) - n;
  }
  return count;
}

}  // namespace tessera::mesh
