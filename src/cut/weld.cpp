// SPDX-License-Identifier: BSD-3-Clause
#include "cut/weld.hpp"

#include <numeric>
#include <tuple>

#include "tessera/base/box.hpp"
#include "tessera/base/single_precision.hpp"
#include "tessera/base/union_find.hpp"

namespace tessera::cut {
namespace {

// The lowest of the points that each one is joined with.
std::vector<LocalIndex> joined_points(const std::vector<Vec3>& points)
{
  // Near points are near along any direction. Along this one few others are: it is no axis.
  constexpr Vec3 kDirection{0.4082, 0.5345, 0.7401};
  const double tolerance = kSinglePrecisionNoise * bounding_box(points).diagonal();
  std::vector<double> along(points.size());
  std::ranges::transform(points, along.begin(), [&](const Vec3& p) { return dot(kDirection, p); });
  std::vector<LocalIndex> order(points.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::sort(order, {}, [&](LocalIndex v) { return std::pair(along[at(v)], v); });
  UnionFind joined(static_cast<LocalIndex>(points.size()));
  for (std::size_t i = 0; i < order.size(); ++i) {
    for (std::size_t j = i + 1; j < order.size(); ++j) {
      if (along[at(order[j])] - along[at(order[i])] > tolerance) break;
      if (norm(points[at(order[j])] - points[at(order[i])]) > tolerance) continue;
      joined.join(order[i], order[j]);
    }
  }
  std::vector<LocalIndex> result(points.size());
  for (LocalIndex v = 0; v < static_cast<LocalIndex>(points.size()); ++v)
    result[at(v)] = joined.find(v);
  return result;
}

// Edges of one triangle before points were joined, and of two of the same face after it.
std::set<std::array<LocalIndex, 2>> seams_of(const std::vector<SurfaceTriangle>& apart,
                                             const std::vector<LocalIndex>& joined)
{
  std::vector<SurfaceTriangle> ends;
  for_each_edge_group(sorted_edges(apart), [&](std::span<const TriangleEdge> edge) {
    if (edge.size() != 1) return;
    const auto& [a, b] = edge.front().vertices;
    const auto [low, high] = std::minmax(joined[at(a)], joined[at(b)]);
    if (low != high) ends.push_back({{low, high, low}, apart[at(edge.front().triangle)].face});
  });
  std::ranges::sort(ends, {},
                    [](const SurfaceTriangle& end) { return std::pair(end.vertices, end.face); });
  std::set<std::array<LocalIndex, 2>> seams;
  for (std::size_t i = 1; i < ends.size(); ++i) {
    if (ends[i].vertices != ends[i - 1].vertices || ends[i].face != ends[i - 1].face) continue;
    seams.insert({ends[i].vertices[0], ends[i].vertices[1]});
  }
  return seams;
}

}  // namespace

WeldedModel weld_faces(const model::ModelDescription& model)
{
  WeldedModel welded;
  const std::span<const double> xyz(model.vertex_xyz);
  std::vector<LocalIndex> order(xyz.size() / 3);
  std::iota(order.begin(), order.end(), 0);
  std::ranges::sort(order, {}, [&](LocalIndex v) { return point_at(xyz, v); });
  std::vector<LocalIndex> place(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    place[at(order[i])] = static_cast<LocalIndex>(i);
    welded.points.push_back(point_at(xyz, order[i]));
  }
  const std::vector<LocalIndex> joined = joined_points(welded.points);
  std::vector<SurfaceTriangle> apart;
  for (std::size_t t = 0; t < model.triangle_face.size(); ++t) {
    std::array<LocalIndex, 3> v{};
    for (std::size_t c = 0; c < 3; ++c) v[c] = place[at(model.triangle_vertices[3 * t + c])];
    apart.push_back({v, model.triangle_face[t]});
    for (LocalIndex& vertex : v) vertex = joined[at(vertex)];
    if (v[0] == v[1] || v[1] == v[2] || v[2] == v[0]) continue;
    std::rotate(v.begin(), std::ranges::min_element(v), v.end());
    welded.triangles.push_back({v, model.triangle_face[t]});
  }
  std::ranges::sort(welded.triangles, {}, [](const SurfaceTriangle& triangle) {
    return std::pair(triangle.vertices, triangle.face);
  });
  welded.seams = seams_of(apart, joined);
  return welded;
}

std::vector<TriangleEdge> sorted_edges(const std::vector<SurfaceTriangle>& triangles)
{
  std::vector<TriangleEdge> edges;
  edges.reserve(3 * triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (std::size_t c = 0; c < 3; ++c) {
      const LocalIndex a = triangles[t].vertices[c];
      const LocalIndex b = triangles[t].vertices[(c + 1) % 3];
      edges.push_back({{std::min(a, b), std::max(a, b)}, static_cast<LocalIndex>(t)});
    }
  }
  std::ranges::sort(edges);
  return edges;
}

}  // namespace tessera::cut
