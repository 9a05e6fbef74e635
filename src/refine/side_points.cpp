// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/refine/lattice_refiner.hpp"

#include "refine/limited.hpp"

namespace tessera::refine {
namespace {

// A point of a column over a skeleton edge at the rim of a wall, put onto the patch without layers
// beside it; the point itself if there is none. `part`: where along the edge, from 0 to 1.
Vec3 side_patch_point(const RefineContext& context, LocalIndex edge, double part, const Vec3& point)
{
  const mesh::Skeleton& skeleton = context.skeleton;
  const LocalIndex patch = skeleton.edge_side_patch[at(edge)];
  if (patch == kNoIndex) return point;
  const double* uv = &skeleton.edge_side_uv[4 * at(edge)];
  const model::SurfaceParameters guess{uv[0] + part * (uv[2] - uv[0]),
                                       uv[1] + part * (uv[3] - uv[1])};
  return context.model.project_to_surface(context.coarse.patch_surface[at(patch)], point, guess)
      .xyz;
}

}  // namespace

Vec3 side_point_of_edge(const RefineContext& context, LocalIndex edge, LocalIndex n, LocalIndex k,
                        const Vec3& point)
{
  const double factor = context.limiter.factor(mesh::LatticePointKey::on_edge(edge, n, k));
  return limited(point, side_patch_point(context, edge, static_cast<double>(k) / n, point), factor);
}

Vec3 side_point_of_vertex(const RefineContext& context, LocalIndex vertex, const Vec3& point)
{
  const mesh::Skeleton& skeleton = context.skeleton;
  const LocalIndex edge = skeleton.vertex_side_edge[at(vertex)];
  if (edge == kNoIndex) return point;
  const std::size_t end = skeleton.edge_vertices[2 * at(edge)] == vertex ? 0 : 1;
  const double factor = context.limiter.factor(key_of_vertex_limit(edge));
  if (skeleton.is_on_wall(edge)) {
    return limited(point, side_patch_point(context, edge, static_cast<double>(end), point), factor);
  }
  const double t = skeleton.edge_parameters[2 * (2 * at(edge) + end)];
  return limited(point, context.model.project_to_curve(skeleton.edge_curve[at(edge)], point, t).xyz,
                 factor);
}

mesh::LatticePointKey key_of_vertex_limit(LocalIndex side_edge)
{
  return mesh::LatticePointKey::on_edge(side_edge, 2, 1);
}

}  // namespace tessera::refine
