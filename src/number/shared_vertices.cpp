// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/number/shared_vertices.hpp"

#include <algorithm>

namespace tessera::number {

std::vector<mesh::HostPoint> shared_vertices(const mesh::Piece& piece)
{
  std::vector<mesh::HostPoint> names;
  names.reserve(at(piece.num_skin_vertices()));
  for (LocalIndex v = 0; v < piece.num_skin_vertices(); ++v) {
    names.push_back(piece.skin_point(v));
  }
  std::ranges::sort(names);
  return names;
}

SharedBy compare_lists(const VertexList& own, std::span<const VertexList> neighbours)
{
  const std::size_t num_vertices = own.vertices.size();
  SharedBy shared;
  shared.on_seam.resize(num_vertices, 0);
  std::vector<char> is_owned(num_vertices, 1);
  // Two materials beside the piece's own may have a seam that ends at one of its vertices.
  std::vector<std::vector<LocalIndex>> materials(num_vertices);
  for (const VertexList& other : neighbours) {
    auto next = other.vertices.begin();
    for (std::size_t v = 0; v < num_vertices; ++v) {
      while (next != other.vertices.end() && *next < own.vertices[v]) ++next;
      if (next == other.vertices.end()) break;
      if (*next != own.vertices[v]) continue;
      if (other.subdomain < own.subdomain) is_owned[v] = 0;
      const bool is_known =
          other.material == own.material
          || std::ranges::find(materials[v], other.material) != materials[v].end();
      if (is_known) shared.on_seam[v] = 1;
      materials[v].push_back(other.material);
    }
  }
  for (std::size_t v = 0; v < num_vertices; ++v) {
    if (is_owned[v] != 0) shared.owned.push_back(own.vertices[v]);
  }
  return shared;
}

}  // namespace tessera::number
