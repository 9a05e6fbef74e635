// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/skeleton_orbits.hpp"

#include <vector>

namespace tessera::mesh {
namespace {

void add_links(const Skeleton& skeleton, LocalIndex from, LocalIndex to, LocalIndex transform,
               std::vector<ImageLink>& vertices, std::vector<ImageLink>& edges)
{
  for (std::size_t c = 0; c < 3; ++c) {
    vertices.push_back({skeleton.triangle_vertices[3 * at(from) + c],
                        skeleton.triangle_vertices[3 * at(to) + c], transform});
    edges.push_back({skeleton.triangle_edges[3 * at(from) + c],
                     skeleton.triangle_edges[3 * at(to) + c], transform});
  }
}

}  // namespace

Orbits find_orbits(const Skeleton& skeleton, const CoarseMesh& coarse,
                   std::span<const LocalIndex> triangle_face)
{
  const SideImages& sides = coarse.images;
  if (sides.are_none()) return {};
  std::vector<LocalIndex> triangle_of(at(coarse.num_faces()), kNoIndex);
  for (std::size_t t = 0; t < triangle_face.size(); ++t) {
    if (triangle_face[t] != kNoIndex)
      triangle_of[at(triangle_face[t])] = static_cast<LocalIndex>(t);
  }
  std::vector<ImageLink> vertices;
  std::vector<ImageLink> edges;
  std::vector<ImageLink> triangles;
  for (LocalIndex f = 0; f < coarse.num_faces(); ++f) {
    const LocalIndex origin = sides.face_origin[at(f)];
    if (origin == kNoIndex) continue;
    const LocalIndex transform = sides.patch_transform[at(coarse.face_patch[at(f)])];
    triangles.push_back({triangle_of[at(origin)], triangle_of[at(f)], transform});
    add_links(skeleton, triangle_of[at(origin)], triangle_of[at(f)], transform, vertices, edges);
  }
  Orbits orbits{.images = {Affine{}}};
  const auto find = [&](LocalIndex num_rows, const std::vector<ImageLink>& links) {
    return find_orbits(num_rows, links, sides.transforms, orbits.images);
  };
  orbits.edges = find(skeleton.num_edges(), edges);
  orbits.triangles = find(skeleton.num_triangles(), triangles);
  for (auto* links : {&vertices, &edges}) {
    std::erase_if(*links, [](const ImageLink& link) { return link.transform == 0; });
  }
  orbits.vertex_columns = find(skeleton.num_vertices(), vertices);
  orbits.edge_columns = find(skeleton.num_edges(), edges);
  return orbits;
}

}  // namespace tessera::mesh
