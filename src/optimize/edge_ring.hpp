// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "optimize/working_mesh.hpp"

namespace tessera::optimize {

// Corners a and b of an edge of a tet and the other two, so that the order a, b, c, d is positive.
struct TetEdge {
  Corner a, b, c, d;
};
inline constexpr std::array<TetEdge, 6> kTetEdges{
    {{0, 1, 2, 3}, {0, 2, 3, 1}, {0, 3, 1, 2}, {1, 2, 0, 3}, {1, 3, 2, 0}, {2, 3, 0, 1}}};

// Rings of more tets are not opened: of 18,000 edges removed from shaft.geo (L = 2) ten had more
// than four.
inline constexpr std::size_t kMaxRing = 7;

// All tets around the edge (a, b). Tet i has ring vertices i and i + 1, and is positive in the
// order a, b, i, i + 1.
struct EdgeRing {
  LocalIndex a = kNoIndex;
  LocalIndex b = kNoIndex;
  std::size_t size = 0;
  std::array<LocalIndex, kMaxRing> vertices;
  std::array<LocalIndex, kMaxRing> tets;

  [[nodiscard]] std::span<const LocalIndex> all_tets() const { return std::span(tets).first(size); }
};

// Gathers the ring of an edge of tet t. False if the edge is on the boundary, if it has more than
// `max_size` tets, or if `stop` is true of one of the others.
template <class Stop>  // (LocalIndex tet) -> bool
[[nodiscard]] bool walk_ring(const WorkingMesh& mesh, LocalIndex t, const TetEdge& edge,
                             std::size_t max_size, const Stop& stop, EdgeRing& ring)
{
  const LocalIndex* vertices = mesh.tet_vertices.data();
  const LocalIndex* first = vertices + 4 * at(t);
  ring.a = first[edge.a];
  ring.b = first[edge.b];
  ring.vertices[0] = first[edge.c];
  ring.size = 0;
  LocalIndex newest = first[edge.d];
  Corner exit = 4 * t + edge.c;  // The way on is opposite to the older ring vertex.
  for (LocalIndex u = t;;) {
    ring.tets[ring.size++] = u;
    const Corner across = mesh.tet_neighbours[at(exit)];
    if (is_boundary(across)) return false;
    u = tet_of(across);
    if (u == t) return ring.size >= 3;
    if (ring.size == max_size || stop(u)) return false;
    ring.vertices[ring.size] = newest;
    exit = 4 * u;
    while (vertices[exit] != newest) ++exit;
    newest = vertices[across];
  }
}

}  // namespace tessera::optimize
