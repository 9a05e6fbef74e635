// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/number/shared_vertices.hpp"

#include <algorithm>

#include "number/compare_keys.hpp"

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
  using Keys = NeighbourKeys<mesh::HostPoint>;
  std::vector<Keys> others;
  for (const VertexList& other : neighbours) {
    others.push_back({other.subdomain, other.material, other.vertices});
  }
  SharedBy shared;
  shared.on_seam =
      compare_keys(Keys{own.subdomain, own.material, own.vertices}, others, shared.owned);
  return shared;
}

}  // namespace tessera::number
