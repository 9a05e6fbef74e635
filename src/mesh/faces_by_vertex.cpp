// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/faces_by_vertex.hpp"

#include <algorithm>

#include "tessera/mesh/tet_topology.hpp"

namespace tessera::mesh {

FacesByVertex::FacesByVertex(std::span<const LocalIndex> tet_vertices, LocalIndex num_vertices)
    : tet_vertices_(tet_vertices)
{
  const std::size_t num_tets = tet_vertices.size() / 4;
  for (TetLists* lists : {&of_lowest_, &of_second_}) {
    lists->first.assign(at(num_vertices), kNoIndex);
    lists->next.assign(num_tets, kNoIndex);
  }
  const auto add = [](TetLists& lists, LocalIndex vertex, std::size_t tet) {
    lists.next[tet] = lists.first[at(vertex)];
    lists.first[at(vertex)] = static_cast<LocalIndex>(tet);
  };
  for (std::size_t tet = num_tets; tet-- > 0;) {
    const SortedTet sorted = sorted_tet(tet_vertices.subspan(4 * tet).first<4>());
    add(of_lowest_, sorted.vertices[0], tet);
    add(of_second_, sorted.vertices[1], tet);
  }
}

std::span<FaceOfTet> FacesByVertex::at_vertex(LocalIndex v)
{
  faces_.clear();
  for (LocalIndex t = of_lowest_.first[at(v)]; t != kNoIndex; t = of_lowest_.next[at(t)]) {
    for (std::size_t without = 1; without < 4; ++without) add_face(t, without);
  }
  for (LocalIndex t = of_second_.first[at(v)]; t != kNoIndex; t = of_second_.next[at(t)]) {
    add_face(t, 0);
  }
  return faces_;
}

// The face without the vertex of this place in ascending order.
void FacesByVertex::add_face(LocalIndex tet, std::size_t without)
{
  const auto corners = tet_vertices_.subspan(4 * at(tet)).first<4>();
  const SortedTet sorted = sorted_tet(corners);
  const auto corner = std::ranges::find(corners, sorted.vertices[without]) - corners.begin();
  const LocalIndex middle = sorted.vertices[without < 2 ? 2 : 1];
  const LocalIndex high = sorted.vertices[without < 3 ? 3 : 2];
  faces_.push_back({(static_cast<std::uint64_t>(middle) << 32) | static_cast<std::uint32_t>(high),
                    (static_cast<std::uint32_t>(4 * tet + corner) << 1)
                        | static_cast<std::uint32_t>(sorted.is_even_face(without))});
}

}  // namespace tessera::mesh
