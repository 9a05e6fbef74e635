// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/mesh/tet_topology.hpp"

#include <string>

#include <fmt/format.h>

#include "tessera/base/error.hpp"
#include "tessera/base/index_lists.hpp"
#include "tessera/mesh/sorted_rows.hpp"

namespace tessera::mesh {

std::vector<std::array<LocalIndex, 3>> faces_of_tets(std::span<const LocalIndex> tet_vertices)
{
  std::vector<std::array<LocalIndex, 3>> faces;
  faces.reserve(tet_vertices.size());
  for (std::size_t t = 0; 4 * t < tet_vertices.size(); ++t) {
    const auto tet = tet_vertices.subspan(4 * t, 4);
    for (const auto& [a, b, c] : kTetFaceCorners) {
      faces.push_back(sorted_triangle(tet[a], tet[b], tet[c]));
    }
  }
  return faces;
}

std::vector<TriangleTets> triangles_of_tets(std::span<const LocalIndex> tet_vertices)
{
  const NumberedRows<3> sides = number_rows(faces_of_tets(tet_vertices));
  std::vector<TriangleTets> triangles;
  triangles.reserve(sides.rows.size());
  for (const auto& vertices : sides.rows) triangles.push_back({.vertices = vertices});
  for (std::size_t side = 0; side < sides.row_of.size(); ++side) {
    TriangleTets& triangle = triangles[at(sides.row_of[side])];
    const auto tet = static_cast<LocalIndex>(side / 4);
    const std::size_t place = triangle.tets[0] == kNoIndex ? 0 : 1;
    if (triangle.tets[place] != kNoIndex) {
      throw MeshError(fmt::format("tets {}, {} and {} share one triangle", triangle.tets[0],
                                  triangle.tets[1], tet));
    }
    triangle.tets[place] = tet;
    triangle.corners[place] = static_cast<LocalIndex>(side % 4);
  }
  return triangles;
}

GlobalIndex count_edges(std::span<const LocalIndex> tet_vertices, LocalIndex num_vertices)
{
  const IndexLists tets_of = rows_by_key(tet_vertices, num_vertices, 4);
  std::vector<LocalIndex> seen_from(at(num_vertices), kNoIndex);
  GlobalIndex num_edges = 0;
  for (LocalIndex v = 0; v < num_vertices; ++v) {
    for (const LocalIndex t : tets_of[v]) {
      for (const LocalIndex other : tet_vertices.subspan(4 * at(t), 4)) {
        if (other <= v || seen_from[at(other)] == v) continue;
        seen_from[at(other)] = v;
        ++num_edges;
      }
    }
  }
  return num_edges;
}

}  // namespace tessera::mesh
