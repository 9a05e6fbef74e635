// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/mesh/tet_topology.hpp"

#include <algorithm>
#include <string>
#include <tuple>

#include <fmt/format.h>

#include "tessera/base/error.hpp"
#include "tessera/base/index_lists.hpp"

#include "mesh/faces_by_vertex.hpp"

namespace tessera::mesh {
namespace {

// Adds the tet of a face to its triangle, which is the last one, or a new one.
void add_face(LocalIndex lowest, const FaceOfTet& face, std::vector<TriangleTets>& triangles)
{
  const auto [middle, highest] = face.other_vertices();
  const std::array vertices{lowest, middle, highest};
  if (triangles.empty() || triangles.back().vertices != vertices) {
    triangles.push_back({.vertices = vertices});
  }
  TriangleTets& triangle = triangles.back();
  const LocalIndex tet = face.corner() / 4;
  const std::size_t place = triangle.tets[0] == kNoIndex ? 0 : 1;
  if (triangle.tets[place] != kNoIndex) {
    throw MeshError(fmt::format("tets {}, {} and {} share one triangle", triangle.tets[0],
                                triangle.tets[1], tet));
  }
  triangle.tets[place] = tet;
  triangle.corners[place] = face.corner() % 4;
}

}  // namespace

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
  if (tet_vertices.empty()) return {};
  const LocalIndex num_vertices = *std::ranges::max_element(tet_vertices) + 1;
  std::vector<TriangleTets> triangles;
  triangles.reserve(tet_vertices.size() / 2);
  FacesByVertex faces(tet_vertices, num_vertices);
  for (LocalIndex v = 0; v < num_vertices; ++v) {
    const auto together = faces.at_vertex(v);
    std::ranges::sort(together, [](const FaceOfTet& a, const FaceOfTet& b) {
      return std::tie(a.others, a.corner_and_side) < std::tie(b.others, b.corner_and_side);
    });
    for (const FaceOfTet& face : together) add_face(v, face, triangles);
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
