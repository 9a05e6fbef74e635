// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/mesh/face_tets.hpp"

#include <array>
#include <map>

namespace tessera::mesh {

std::vector<TriangleTets> tets_of_faces(const CoarseMesh& mesh,
                                        std::span<const TriangleTets> triangles)
{
  std::map<std::array<LocalIndex, 3>, LocalIndex> face_of;
  for (LocalIndex f = 0; f < mesh.num_faces(); ++f) {
    const LocalIndex* v = &mesh.face_vertices[3 * at(f)];
    face_of.emplace(sorted_triangle(v[0], v[1], v[2]), f);
  }
  std::vector<TriangleTets> of_faces(at(mesh.num_faces()));
  for (const TriangleTets& triangle : triangles) {
    const auto found = face_of.find(triangle.vertices);
    if (found != face_of.end()) of_faces[at(found->second)] = triangle;
  }
  return of_faces;
}

std::vector<TriangleTets> tets_of_faces(const CoarseMesh& mesh)
{
  return tets_of_faces(mesh, triangles_of_tets(mesh.tet_vertices));
}

}  // namespace tessera::mesh
