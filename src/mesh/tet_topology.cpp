// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/mesh/tet_topology.hpp"

#include <string>

#include <fmt/format.h>

#include "tessera/base/error.hpp"
#include "tessera/mesh/sorted_rows.hpp"

namespace tessera::mesh {

std::vector<TriangleTets> triangles_of_tets(std::span<const LocalIndex> tet_vertices)
{
  struct Side {
    std::array<LocalIndex, 3> vertices;
    LocalIndex tet;
    LocalIndex corner;
  };
  std::vector<Side> sides;
  sides.reserve(tet_vertices.size());
  for (std::size_t t = 0; 4 * t < tet_vertices.size(); ++t) {
    const auto tet = tet_vertices.subspan(4 * t, 4);
    for (std::size_t corner = 0; corner < 4; ++corner) {
      const auto& face = kTetFaceCorners[corner];
      sides.push_back({sorted_triangle(tet[face[0]], tet[face[1]], tet[face[2]]),
                       static_cast<LocalIndex>(t), static_cast<LocalIndex>(corner)});
    }
  }
  sort_by_smallest(
      sides, [](const Side& side) { return side.vertices[0]; },
      [](const Side& a, const Side& b) {
        return a.vertices != b.vertices ? a.vertices < b.vertices : a.tet < b.tet;
      });

  std::vector<TriangleTets> triangles;
  triangles.reserve(sides.size() / 2 + 1);
  for (const Side& side : sides) {
    if (triangles.empty() || triangles.back().vertices != side.vertices) {
      triangles.push_back({side.vertices, {side.tet, kNoIndex}, {side.corner, kNoIndex}});
      continue;
    }
    TriangleTets& triangle = triangles.back();
    if (triangle.tets[1] != kNoIndex) {
      throw MeshError(fmt::format("tets {}, {} and {} share one triangle", triangle.tets[0],
                                  triangle.tets[1], side.tet));
    }
    triangle.tets[1] = side.tet;
    triangle.corners[1] = side.corner;
  }
  return triangles;
}

}  // namespace tessera::mesh
