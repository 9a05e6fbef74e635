// SPDX-License-Identifier: BSD-3-Clause
#include "cut/solid_surfaces.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "tessera/base/index_lists.hpp"
#include "tessera/base/union_find.hpp"

#include "cut/moments.hpp"
#include "cut/sheets.hpp"
#include "cut/weld.hpp"

namespace tessera::cut {
namespace {

// Triangles stay inside curved faces, and a description may have the volume of the faces
// themselves.
constexpr double kLargestVolumeError = 0.05;
constexpr double kLargestGap = 1e-3;  // Sum of area times normal, over the area.

// Half of a curve is left if a plane cuts it in its middle. Of a full circle a third is two radii.
constexpr double kSizeOverLength = 1.0 / 2.0;
constexpr double kSizeOfLoop = 1.0 / 3.0;

using Seams = std::set<std::array<LocalIndex, 2>>;

void add_feature_edges(const Seams& seams, PartSurface& surface)
{
  for_each_edge_group(sorted_edges(surface.triangles), [&](std::span<const TriangleEdge> edge) {
    const LocalIndex first = surface.triangles[at(edge.front().triangle)].face;
    LocalIndex second = first;
    for (const TriangleEdge& use : edge) {
      const LocalIndex face = surface.triangles[at(use.triangle)].face;
      if (face != first) second = face;
    }
    const bool is_seam = seams.contains(edge.front().vertices);
    if (edge.size() == 2 && first == second && !is_seam) return;
    surface.edges.push_back(
        {edge.front().vertices, {std::min(first, second), std::max(first, second)}, 0.0});
  });
}

// Edges between the same two faces are one curve if they follow each other.
void measure_curves(PartSurface& surface, double coarse_size)
{
  const auto num_edges = static_cast<LocalIndex>(surface.edges.size());
  std::vector<LocalIndex> ends;
  for (const FeatureEdge& edge : surface.edges) {
    ends.insert(ends.end(), edge.vertices.begin(), edge.vertices.end());
  }
  const IndexLists edges_at = rows_by_key(ends, static_cast<LocalIndex>(surface.points.size()), 2);
  UnionFind curves(num_edges);
  std::vector<bool> is_inside(surface.points.size(), false);
  for (LocalIndex v = 0; v < edges_at.num_lists(); ++v) {
    const auto here = edges_at[v];
    is_inside[at(v)] =
        here.size() == 2 && surface.edges[at(here[0])].faces == surface.edges[at(here[1])].faces;
    if (is_inside[at(v)]) curves.join(here[0], here[1]);
  }
  std::vector<double> length(at(num_edges), 0.0);
  std::vector<double> share(at(num_edges), kSizeOfLoop);
  for (LocalIndex e = 0; e < num_edges; ++e) {
    const auto& [a, b] = surface.edges[at(e)].vertices;
    length[at(curves.find(e))] += norm(surface.points[at(b)] - surface.points[at(a)]);
    if (!is_inside[at(a)] || !is_inside[at(b)]) share[at(curves.find(e))] = kSizeOverLength;
  }
  for (LocalIndex e = 0; e < num_edges; ++e) {
    const std::size_t curve = at(curves.find(e));
    surface.edges[at(e)].size = std::min(coarse_size, share[curve] * length[curve]);
  }
}

std::string reason_against(const PartSurface& surface, double described_volume)
{
  Vec3 area{};
  double size = 0.0;
  for (const SurfaceTriangle& triangle : surface.triangles) {
    const auto& [a, b, c] = triangle.vertices;
    const Vec3 p = surface.points[at(a)];
    const Vec3 own = 0.5 * cross(surface.points[at(b)] - p, surface.points[at(c)] - p);
    area = area + own;
    size += norm(own);
  }
  const double volume = volume_of(surface);
  if (!(size > 0.0) || norm(area) > kLargestGap * size) return "its triangles do not close";
  if (!(std::abs(volume - described_volume) <= kLargestVolumeError * described_volume)) {
    return fmt::format("its triangles enclose {:.6g}, not {:.6g}", volume, described_volume);
  }
  return {};
}

class Collector {
 public:
  explicit Collector(const WeldedModel& welded)
      : welded_(welded), own_(welded.points.size(), kNoIndex)
  {
  }

  void add(SurfaceTriangle triangle, bool is_turned)
  {
    if (is_turned) std::swap(triangle.vertices[1], triangle.vertices[2]);
    for (LocalIndex& v : triangle.vertices) {
      LocalIndex& own = own_[at(v)];
      if (own == kNoIndex) {
        own = static_cast<LocalIndex>(surface_.points.size());
        surface_.points.push_back(welded_.points[at(v)]);
      }
      v = own;
    }
    surface_.triangles.push_back(triangle);
  }

  SolidSurface finish(double described_volume, double coarse_size)
  {
    add_feature_edges(own_seams(), surface_);
    measure_curves(surface_, coarse_size);
    std::string reason = reason_against(surface_, described_volume);
    return {std::move(surface_), std::move(reason)};
  }

 private:
  [[nodiscard]] Seams own_seams() const
  {
    Seams seams;
    for (const auto& [a, b] : welded_.seams) {
      const auto [low, high] = std::minmax(own_[at(a)], own_[at(b)]);
      if (low != kNoIndex) seams.insert({low, high});
    }
    return seams;
  }

  const WeldedModel& welded_;
  std::vector<LocalIndex> own_;
  PartSurface surface_{};
};

}  // namespace

std::vector<SolidSurface> solid_surfaces(const model::ModelDescription& model, double coarse_size)
{
  const WeldedModel welded = weld_faces(model);
  const std::vector<TriangleSolids> solids = solids_of_triangles(welded, model);
  std::vector<LocalIndex> sides;
  for (const TriangleSolids& two : solids) sides.insert(sides.end(), two.begin(), two.end());
  const auto num_solids = static_cast<LocalIndex>(model.solids.size());
  const IndexLists triangles_of = rows_by_key(sides, num_solids, 2);
  std::vector<SolidSurface> result;
  for (LocalIndex s = 0; s < num_solids; ++s) {
    Collector collector(welded);
    for (const LocalIndex t : triangles_of[s]) {
      const bool is_turned = solids[at(t)][0] != s;
      SurfaceTriangle triangle = welded.triangles[at(t)];
      triangle.neighbour = solids[at(t)][is_turned ? 0 : 1];
      collector.add(triangle, is_turned);
    }
    result.push_back(collector.finish(model.solids[at(s)].volume, coarse_size));
  }
  return result;
}

}  // namespace tessera::cut
