// SPDX-License-Identifier: BSD-3-Clause
#include "cut/landmarks.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

namespace tessera::cut {

namespace {

// Of each face the largest size of its curves. So a small hole's wall is as small as its rims.
std::map<LocalIndex, double> sizes_of_faces(const PartSurface& part)
{
  std::set<LocalIndex> caps;
  for (const Cap& cap : part.caps) caps.insert(cap.label);
  std::map<LocalIndex, double> sizes;
  for (const FeatureEdge& edge : part.edges) {
    if (edge.foreign != kNoIndex || caps.contains(edge.faces[0]) || caps.contains(edge.faces[1])) {
      continue;
    }
    for (const LocalIndex face : edge.faces) sizes[face] = std::max(sizes[face], edge.size);
  }
  return sizes;
}

}  // namespace

LandmarkFinder::LandmarkFinder(const PartSurface& part, double coarse_size)
    : part_(part),
      num_edges_(part.points.size(), 0),
      size_(part.points.size(), coarse_size),
      neighbours_(part.points.size(), {kNoIndex, kNoIndex}),
      has_triangle_(part.points.size(), false)
{
  const std::map<LocalIndex, double> sizes = sizes_of_faces(part);
  for (const SurfaceTriangle& triangle : part.triangles) {
    const auto size = sizes.find(triangle.face);
    for (const LocalIndex v : triangle.vertices) {
      has_triangle_[at(v)] = true;
      if (size != sizes.end()) size_[at(v)] = std::min(coarse_size, size->second);
    }
  }
  // At curves their sizes count, not those of the faces.
  for (const FeatureEdge& edge : part.edges) {
    for (const LocalIndex v : edge.vertices) size_[at(v)] = coarse_size;
  }
  for (const FeatureEdge& edge : part.edges) {
    for (std::size_t end = 0; end < 2; ++end) {
      const std::size_t v = at(edge.vertices[end]);
      if (num_edges_[v] < 2) neighbours_[v][at(num_edges_[v])] = edge.vertices[1 - end];
      ++num_edges_[v];
      size_[v] = std::min(size_[v], edge.size);
    }
  }
}

std::vector<Landmark> LandmarkFinder::find(const std::vector<double>& heights) const
{
  // How often the border of the triangles around a point changes sides. Twice: the face goes
  // through the plane. Never: it touches it. More: it is a saddle.
  std::vector<LocalIndex> num_changes(heights.size(), 0);
  const auto is_above = [&](LocalIndex p, LocalIndex of) {
    return std::pair(heights[at(p)], p) > std::pair(heights[at(of)], of);
  };
  for (const SurfaceTriangle& triangle : part_.triangles) {
    for (std::size_t c = 0; c < 3; ++c) {
      const LocalIndex v = triangle.vertices[c];
      if (num_edges_[at(v)] > 0) continue;
      num_changes[at(v)] +=
          is_above(triangle.vertices[(c + 1) % 3], v) != is_above(triangle.vertices[(c + 2) % 3], v)
              ? 1
              : 0;
    }
  }
  std::vector<Landmark> found;
  for (LocalIndex v = 0; v < static_cast<LocalIndex>(heights.size()); ++v) {
    const LocalIndex num_edges = num_edges_[at(v)];
    const bool is_clear = num_edges == 0   ? num_changes[at(v)] == 2 || !has_triangle_[at(v)]
                          : num_edges == 2 ? !touches_curve(v, heights)
                                           : false;
    if (!is_clear) found.push_back({heights[at(v)], size_[at(v)]});
  }
  std::ranges::sort(found, {}, [](const Landmark& l) { return std::pair(l.height, l.size); });
  return found;
}

bool LandmarkFinder::touches_curve(LocalIndex v, const std::vector<double>& heights) const
{
  const auto& [a, b] = neighbours_[at(v)];
  return (heights[at(a)] - heights[at(v)]) * (heights[at(b)] - heights[at(v)]) >= 0.0;
}

double clearance_of(const std::vector<Landmark>& landmarks, double offset, double coarse_size,
                    double largest)
{
  const double reach = largest * coarse_size;
  auto landmark = std::ranges::lower_bound(landmarks, offset - reach, {}, &Landmark::height);
  double clearance = largest;
  for (; landmark != landmarks.end() && landmark->height <= offset + reach; ++landmark) {
    clearance = std::min(clearance, std::abs(landmark->height - offset) / landmark->size);
  }
  return clearance;
}

}  // namespace tessera::cut
