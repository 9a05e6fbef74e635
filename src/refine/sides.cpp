// SPDX-License-Identifier: BSD-3-Clause
#include "refine/sides.hpp"

#include <algorithm>

namespace tessera::refine {

bool is_wall_edge(const mesh::Complex& complex, const RefineContext& context, LocalIndex e)
{
  const LocalIndex edge = complex.edge_skeleton[at(e)];
  return edge != kNoIndex && context.skeleton.is_on_wall(edge);
}

bool is_wall_triangle(const mesh::Complex& complex, const RefineContext& context, LocalIndex t)
{
  const LocalIndex triangle = complex.triangle_skeleton[at(t)];
  return triangle != kNoIndex
         && context.coarse.layers.is_wall(context.skeleton.triangle_patch[at(triangle)]);
}

Vec3 end_of_column(const RefineContext& context, Side side, LocalIndex coarse_vertex)
{
  return side == Side::walls ? context.coarse.layers.wall(coarse_vertex)
                             : context.coarse.position(coarse_vertex);
}

bool has_column(const RefineContext& context, LocalIndex coarse_vertex)
{
  const mesh::WallLayers& layers = context.coarse.layers;
  return !layers.are_none() && layers.wall(coarse_vertex) != context.coarse.position(coarse_vertex);
}

bool has_columns(const RefineContext& context, LocalIndex edge)
{
  const mesh::Skeleton& skeleton = context.skeleton;
  const LocalIndex* ends = &skeleton.edge_vertices[2 * at(edge)];
  return skeleton.is_on_wall(edge) && std::any_of(ends, ends + 2, [&](LocalIndex end) {
           return has_column(context, skeleton.vertex_coarse[at(end)]);
         });
}

const mesh::OrbitTable& orbits_of_edge(const RefineContext& context, Side side, LocalIndex edge)
{
  const mesh::Orbits& orbits = context.skeleton.orbits;
  return side == Side::tets && has_columns(context, edge) ? orbits.edge_columns : orbits.edges;
}

}  // namespace tessera::refine
