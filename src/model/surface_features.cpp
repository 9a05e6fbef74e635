// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/model/surface_features.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include <fmt/format.h>

#include "tessera/base/single_precision.hpp"
#include "tessera/base/triangle.hpp"
#include "tessera/mesh/coarse_mesh.hpp"
#include "tessera/mesh/half_edges.hpp"

namespace tessera::model {
namespace {

LocalIndex longest_half_edge(const TriangleSurface& surface, LocalIndex t)
{
  const std::array<Vec3, 3> corners = surface.corners(t);
  LocalIndex longest = 0;
  double longest_length = -1.0;
  for (LocalIndex c = 0; c < 3; ++c) {
    const double length = norm(corners[at((c + 1) % 3)] - corners[at(c)]);
    if (length > longest_length) {
      longest = c;
      longest_length = length;
    }
  }
  return 3 * t + longest;
}

// Zero if the height is noise: then it may be off by several degrees.
Vec3 own_normal(const TriangleSurface& surface, LocalIndex t, double noisy_height)
{
  const std::array<Vec3, 3> corners = surface.corners(t);
  const Vec3 n = normal_of(corners);
  const double length = norm(n);
  if (length <= noisy_height * longest_side(corners)) return {};
  return (1.0 / length) * n;
}

// Marks feature edges by half-edge.
std::vector<bool> feature_half_edges(const TriangleSurface& surface,
                                     std::span<const LocalIndex> opposite, double feature_angle_deg)
{
  const std::vector<Vec3> normals = triangle_normals(surface);
  const double cos_angle = std::cos(feature_angle_deg * std::numbers::pi / 180.0);
  std::vector<bool> is_feature(opposite.size());
  for (std::size_t h = 0; h < opposite.size(); ++h) {
    const std::size_t here = h / 3;
    const std::size_t there = at(opposite[h]) / 3;
    is_feature[h] = dot(normals[here], normals[there]) < cos_angle
                    || surface.triangle_solid[here] != surface.triangle_solid[there];
  }
  return is_feature;
}

// Returns the number of patches; a patch's first triangle comes before that of the next.
LocalIndex mark_patches(std::span<const LocalIndex> opposite, const std::vector<bool>& is_feature,
                        std::vector<LocalIndex>& triangle_patch)
{
  triangle_patch.assign(opposite.size() / 3, kNoIndex);
  LocalIndex num_patches = 0;
  std::vector<LocalIndex> to_visit;
  for (std::size_t start = 0; start < triangle_patch.size(); ++start) {
    if (triangle_patch[start] != kNoIndex) continue;
    triangle_patch[start] = num_patches;
    to_visit.push_back(static_cast<LocalIndex>(start));
    while (!to_visit.empty()) {
      const LocalIndex t = to_visit.back();
      to_visit.pop_back();
      for (LocalIndex h = 3 * t; h < 3 * t + 3; ++h) {
        const LocalIndex neighbour = opposite[at(h)] / 3;
        if (is_feature[at(h)] || triangle_patch[at(neighbour)] != kNoIndex) continue;
        triangle_patch[at(neighbour)] = num_patches;
        to_visit.push_back(neighbour);
      }
    }
    ++num_patches;
  }
  return num_patches;
}

std::vector<std::string> name_patches(const TriangleSurface& surface,
                                      const std::vector<LocalIndex>& triangle_patch,
                                      LocalIndex num_patches)
{
  std::vector<LocalIndex> patch_solid(at(num_patches));
  for (std::size_t t = 0; t < triangle_patch.size(); ++t) {
    patch_solid[at(triangle_patch[t])] = surface.triangle_solid[t];
  }
  std::vector<LocalIndex> solid_num_patches(surface.solid_names.size());
  for (const LocalIndex s : patch_solid) ++solid_num_patches[at(s)];

  std::vector<LocalIndex> solid_num_named(surface.solid_names.size());
  std::vector<std::string> names;
  for (std::size_t p = 0; p < patch_solid.size(); ++p) {
    const std::size_t s = at(patch_solid[p]);
    const std::string& solid = surface.solid_names[s];
    const std::string number = fmt::to_string(++solid_num_named[s]);
    if (solid.empty()) {
      names.push_back(mesh::default_patch_name(static_cast<LocalIndex>(p)));
    } else {
      names.push_back(solid_num_patches[s] == 1 ? solid : fmt::format("{}_{}", solid, number));
    }
  }
  return names;
}

// Follows feature edges from vertex to vertex.
class CurveWalk {
 public:
  CurveWalk(SurfaceFeatures& features, LocalIndex num_vertices)
      : features_(features), vertex_edges_(at(num_vertices))
  {
    for (std::size_t i = 0; i < features.edge_vertices.size(); ++i) {
      vertex_edges_[at(features.edge_vertices[i])].push_back(static_cast<LocalIndex>(i / 2));
    }
    features.edge_curve.assign(features.edge_vertices.size() / 2, kNoIndex);
  }

  void walk()
  {
    for (std::size_t v = 0; v < vertex_edges_.size(); ++v) {
      if (vertex_edges_[v].size() == 2) continue;
      for (const LocalIndex e : vertex_edges_[v]) follow(static_cast<LocalIndex>(v), e);
    }
    // What is left are loops without an end.
    for (std::size_t e = 0; e < features_.edge_curve.size(); ++e) {
      follow(features_.edge_vertices[2 * e], static_cast<LocalIndex>(e));
    }
  }

 private:
  void follow(LocalIndex vertex, LocalIndex edge)
  {
    if (features_.edge_curve[at(edge)] != kNoIndex) return;
    const LocalIndex curve = features_.num_curves();
    features_.curve_vertices.values.push_back(vertex);
    while (edge != kNoIndex) {
      features_.edge_curve[at(edge)] = curve;
      const std::size_t row = 2 * at(edge);
      vertex = features_.edge_vertices[row] == vertex ? features_.edge_vertices[row + 1]
                                                      : features_.edge_vertices[row];
      features_.curve_vertices.values.push_back(vertex);
      edge = next_edge(vertex);
    }
    features_.curve_vertices.end_list();
  }

  [[nodiscard]] LocalIndex next_edge(LocalIndex vertex) const
  {
    const std::vector<LocalIndex>& edges = vertex_edges_[at(vertex)];
    if (edges.size() != 2) return kNoIndex;
    for (const LocalIndex e : edges) {
      if (features_.edge_curve[at(e)] == kNoIndex) return e;
    }
    return kNoIndex;
  }

  SurfaceFeatures& features_;
  std::vector<std::vector<LocalIndex>> vertex_edges_;
};

}  // namespace

LocalIndex SurfaceFeatures::curve_of_edge(LocalIndex a, LocalIndex b) const
{
  const std::pair wanted = std::minmax(a, b);
  std::size_t first = 0;
  std::size_t last = edge_curve.size();
  while (first < last) {
    const std::size_t middle = (first + last) / 2;
    const std::pair here(edge_vertices[2 * middle], edge_vertices[2 * middle + 1]);
    if (here == std::pair<LocalIndex, LocalIndex>(wanted)) return edge_curve[middle];
    if (here < std::pair<LocalIndex, LocalIndex>(wanted)) {
      first = middle + 1;
    } else {
      last = middle;
    }
  }
  return kNoIndex;
}

std::vector<Vec3> triangle_normals(const TriangleSurface& surface)
{
  const double noisy_height = kSinglePrecisionNoise * box_diagonal(surface);
  std::vector<Vec3> normals;
  std::vector<LocalIndex> without_normal;
  for (LocalIndex t = 0; t < surface.num_triangles(); ++t) {
    normals.push_back(own_normal(surface, t, noisy_height));
    if (normals.back() == Vec3{}) without_normal.push_back(t);
  }
  if (without_normal.empty()) return normals;

  const auto opposite =
      mesh::opposite_half_edges(mesh::half_edges_of_edges(surface.triangle_vertices));
  for (const LocalIndex t : without_normal) {
    LocalIndex source = t;
    // Two slivers may lie longest edge to longest edge, or more in a ring: give up after a few.
    for (int step = 0; step < 8 && normals[at(source)] == Vec3{}; ++step) {
      source = opposite[at(longest_half_edge(surface, source))] / 3;
    }
    normals[at(t)] = normals[at(source)];
    if (normals[at(t)] == Vec3{}) normals[at(t)] = own_normal(surface, t, 0.0);
    if (normals[at(t)] == Vec3{}) normals[at(t)] = {0.0, 0.0, 1.0};
  }
  return normals;
}

SurfaceFeatures find_features(const TriangleSurface& surface, double feature_angle_deg)
{
  const IndexLists edges = mesh::half_edges_of_edges(surface.triangle_vertices);
  const std::vector<LocalIndex> opposite = mesh::opposite_half_edges(edges);
  const std::vector<bool> is_feature = feature_half_edges(surface, opposite, feature_angle_deg);

  SurfaceFeatures features;
  const LocalIndex num_patches = mark_patches(opposite, is_feature, features.triangle_patch);
  features.patch_names = name_patches(surface, features.triangle_patch, num_patches);
  for (LocalIndex e = 0; e < edges.num_lists(); ++e) {
    const LocalIndex h = edges[e][0];
    if (!is_feature[at(h)]) continue;
    const LocalIndex a = surface.triangle_vertices[at(h)];
    const LocalIndex b = surface.triangle_vertices[at(mesh::next_in_triangle(h))];
    features.edge_vertices.push_back(std::min(a, b));
    features.edge_vertices.push_back(std::max(a, b));
  }
  CurveWalk(features, surface.num_vertices()).walk();
  return features;
}

}  // namespace tessera::model
