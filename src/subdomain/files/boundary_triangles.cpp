// SPDX-License-Identifier: BSD-3-Clause
#include "subdomain/files/boundary_triangles.hpp"

namespace tessera::subdomain {

void add_boundary(const mesh::Skin& skin, const mesh::Skeleton& skeleton,
                  const std::vector<LocalIndex>& triangle_tet, mesh::Piece& piece)
{
  for (LocalIndex t = 0; t < skin.num_triangles(); ++t) {
    const LocalIndex parent = skin.triangle_parent[at(t)];
    const LocalIndex patch = skeleton.triangle_patch[at(parent)];
    if (patch == kNoIndex || skeleton.triangle_owner(parent) != piece.subdomain) continue;
    for (std::size_t c = 0; c < 3; ++c) {
      piece.boundary_vertices.push_back(skin.triangle_vertices[3 * at(t) + c]);
    }
    piece.boundary_patch.push_back(patch);
    piece.boundary_tet.push_back(triangle_tet[at(t)]);
  }
}

}  // namespace tessera::subdomain
