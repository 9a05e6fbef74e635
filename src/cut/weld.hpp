// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <set>
#include <span>
#include <vector>

#include "tessera/model/description.hpp"

#include "cut/part_surface.hpp"

namespace tessera::cut {

/// Triangles of all faces of a model with the points that they share.
struct WeldedModel {
  std::vector<Vec3> points{};                ///< By position.
  std::vector<SurfaceTriangle> triangles{};  ///< Lowest vertex first; by vertices, then face.
  /// Where a face meets itself, as a cylinder does: an edge of the model. Lower vertex first.
  std::set<std::array<LocalIndex, 2>> seams{};
};

/// @brief Joins points that are within 1e-6 of the box diagonal, and drops what has no area then.
[[nodiscard]] WeldedModel weld_faces(const model::ModelDescription& model);

/// One of the three edges of a triangle.
struct TriangleEdge {
  std::array<LocalIndex, 2> vertices{};  ///< Lower one first.
  LocalIndex triangle = kNoIndex;

  friend auto operator<=>(const TriangleEdge&, const TriangleEdge&) = default;
};

/// @brief All edges of triangles; those on the same vertices follow each other.
[[nodiscard]] std::vector<TriangleEdge> sorted_edges(const std::vector<SurfaceTriangle>& triangles);

/// @brief Calls visit(span of TriangleEdge) for the triangles on each edge.
template <class Visit>
void for_each_edge_group(const std::vector<TriangleEdge>& sorted, const Visit& visit)
{
  for (std::size_t begin = 0; begin < sorted.size();) {
    std::size_t end = begin + 1;
    while (end < sorted.size() && sorted[end].vertices == sorted[begin].vertices) ++end;
    visit(std::span(sorted).subspan(begin, end - begin));
    begin = end;
  }
}

}  // namespace tessera::cut
