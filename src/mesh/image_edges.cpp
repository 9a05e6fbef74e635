// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/mesh/image_edges.hpp"

#include "tessera/mesh/tet_topology.hpp"
#include "tessera/mesh/triangle_grading.hpp"

namespace tessera::mesh {

std::vector<ImageEdge> image_edges(const CoarseMesh& mesh, ImageKind kind)
{
  const SideImages& sides = mesh.images;
  const auto corners_of = [&](LocalIndex face) {
    const LocalIndex* v = &mesh.face_vertices[3 * at(face)];
    return sorted_triangle(v[0], v[1], v[2]);
  };
  const auto is_meant = [&](LocalIndex face) {
    const LocalIndex patch = mesh.face_patch[at(face)];
    if (kind == ImageKind::all) return true;
    if (kind == ImageKind::periodic) return sides.patch_transform[at(patch)] != 0;
    return sides.is_joint(patch) == (kind == ImageKind::joints);
  };
  std::vector<ImageEdge> edges;
  for (LocalIndex f = 0; !sides.are_none() && f < mesh.num_faces(); ++f) {
    if (sides.face_origin[at(f)] == kNoIndex || !is_meant(f)) continue;
    const auto from = corners_of(sides.face_origin[at(f)]);
    const auto to = corners_of(f);
    const LocalIndex transform = sides.patch_transform[at(mesh.face_patch[at(f)])];
    for (const auto& [a, b] : kSideEnds) {
      edges.push_back({{from[a], from[b]}, {to[a], to[b]}, transform});
    }
  }
  return edges;
}

VertexOrbits find_vertex_orbits(const CoarseMesh& mesh, ImageKind kind)
{
  std::vector<ImageLink> links;
  for (const ImageEdge& edge : image_edges(mesh, kind)) {
    for (std::size_t end = 0; end < 2; ++end) {
      links.push_back({edge.from[end], edge.to[end], edge.transform});
    }
  }
  VertexOrbits orbits{.images = {Affine{}}};
  orbits.vertices = find_orbits(mesh.num_vertices(), links, mesh.images.transforms, orbits.images);
  return orbits;
}

}  // namespace tessera::mesh
