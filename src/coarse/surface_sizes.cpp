// SPDX-License-Identifier: BSD-3-Clause
#include "coarse/surface_sizes.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <queue>
#include <utility>

#include "tessera/base/repair.hpp"

#include "coarse/editable_surface.hpp"

namespace tessera::coarse {
namespace {

using Edge = PatchSurface::Edge;

// Of the largest size: smaller radii and curves are not resolved. This mesher is for models with
// defects, where radii of nothing would make millions of triangles.
constexpr double kLeastSize = 0.1;

// The same where the surface goes round: on wires, pins and their holes. With edges longer than the
// radius three or four would go round, and points of refinement would pass through the other side.
constexpr double kLeastOfRound = 0.04;

// The surface goes round a vertex's radius if it looks so far the other way (120 degrees) within so
// many radii. A rounded edge of a right angle does not.
constexpr double kOtherWay = -0.5;
constexpr double kAround = 2.2;

// Triangles that meet at a larger angle (60 degrees) are not of one round piece.
constexpr double kLeastSmoothCosine = 0.5;

// Where so many triangles are that near, they are fine enough as they are.
constexpr std::size_t kMostTriangles = 1000;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// A triangle that is flatter has no normal that says anything.
constexpr double kFlat = 1e-3;

// A closed curve gets this many edges at least, whatever its radius.
constexpr double kEdgesOfLoop = 6.0;

// Below it, in radians, the angle of two triangles or edges is the tessellation's noise.
constexpr double kLeastTurn = 1e-3;

double angle_between(const Vec3& a, const Vec3& b)
{
  return std::atan2(norm(cross(a, b)), dot(a, b));
}

using EdgeTriangles = std::map<Edge, std::vector<std::size_t>>;

EdgeTriangles triangles_by_edge(const PatchSurface& surface)
{
  EdgeTriangles triangles;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const PatchSurface::Triangle& v = surface.triangles[t];
    for (std::size_t c = 0; c < 3; ++c) {
      const auto [low, high] = std::minmax(v[c], v[(c + 1) % 3]);
      triangles[{low, high}].push_back(t);
    }
  }
  return triangles;
}

Neighbours neighbours_of(const PatchSurface& surface, const EdgeTriangles& edges)
{
  Neighbours neighbours(surface.vertex_xyz.size());
  for (const auto& [edge, triangles] : edges) {
    neighbours[at(edge[0])].push_back(edge[1]);
    neighbours[at(edge[1])].push_back(edge[0]);
  }
  return neighbours;
}

// Finds where a surface goes round its own radius, as on a wire.
class RoundFinder {
 public:
  RoundFinder(const PatchSurface& surface, const EdgeTriangles& edge_triangles)
      : surface_(surface),
        beside_(surface.triangles.size()),
        seen_from_(surface.triangles.size(), 0)
  {
    for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
      const Vec3 normal = normal_of(surface.corners(t));
      normals_.push_back(norm(normal) > 0.0 ? unit(normal) : Vec3{});
    }
    for (const auto& [edge, two] : edge_triangles) {
      if (two.size() != 2 || cosine(two[0], two[1]) <= kLeastSmoothCosine) continue;
      beside_[two[0]].push_back(two[1]);
      beside_[two[1]].push_back(two[0]);
    }
  }

  // Whether the surface that goes on smoothly from one of the vertex's triangles looks the other
  // way near.
  [[nodiscard]] bool goes_round(std::size_t v, double radius,
                                const std::vector<std::size_t>& triangles)
  {
    const std::size_t before = num_searches_;
    return std::ranges::any_of(triangles, [&](std::size_t first) {
      return seen_from_[first] <= before && looks_back(first, surface_.vertex_xyz[v], radius);
    });
  }

 private:
  // Of the angle of two triangles; one without a normal looks as the other does.
  [[nodiscard]] double cosine(std::size_t t, std::size_t other) const
  {
    const bool has_both = normals_[t] != Vec3{} && normals_[other] != Vec3{};
    return has_both ? dot(normals_[t], normals_[other]) : 1.0;
  }

  [[nodiscard]] bool looks_back(std::size_t first, const Vec3& place, double radius)
  {
    const std::size_t search = ++num_searches_;
    std::vector<std::size_t> reached{first};
    seen_from_[first] = search;
    for (std::size_t i = 0; i < reached.size() && i < kMostTriangles; ++i) {
      if (cosine(reached[i], first) < kOtherWay) return true;
      for (const std::size_t other : beside_[reached[i]]) {
        if (seen_from_[other] == search || !is_near(other, place, kAround * radius)) continue;
        seen_from_[other] = search;
        reached.push_back(other);
      }
    }
    return false;
  }

  [[nodiscard]] bool is_near(std::size_t t, const Vec3& place, double distance) const
  {
    return std::ranges::any_of(surface_.triangles[t], [&](LocalIndex corner) {
      return norm(surface_.vertex_xyz[at(corner)] - place) < distance;
    });
  }

  const PatchSurface& surface_;
  std::vector<Vec3> normals_{};  // Of length 1, or zero.
  std::vector<std::vector<std::size_t>>
      beside_;                          // Neighbours of each triangle, where it is smooth.
  std::vector<std::size_t> seen_from_;  // The search that reached each triangle last, from 1.
  std::size_t num_searches_ = 0;
};

class SizeField {
 public:
  SizeField(const PatchSurface& surface, const CoarseOptions& options)
      : surface_(surface),
        options_(options),
        sizes_(surface.vertex_xyz.size(), options.max_size),
        radii_(surface.vertex_xyz.size(), kInfinity),
        edge_triangles_(triangles_by_edge(surface))
  {
  }

  std::vector<double> run() &&
  {
    for (const auto& [edge, triangles] : edge_triangles_) bend_surface(edge, triangles);
    bend_and_shorten_curves();
    resolve_round_places();
    grade(surface_.vertex_xyz, neighbours_of(surface_, edge_triangles_), options_.grading, sizes_);
    return std::move(sizes_);
  }

 private:
  [[nodiscard]] const Vec3& xyz(LocalIndex v) const { return surface_.vertex_xyz[at(v)]; }
  [[nodiscard]] double length(const Edge& edge) const { return norm(xyz(edge[1]) - xyz(edge[0])); }

  void restrict(LocalIndex v, double size)
  {
    const double least = kLeastSize * options_.max_size;
    sizes_[at(v)] = std::max(least, std::min(sizes_[at(v)], size));
  }

  // Two triangles that meet inside a patch: their angle over the distance of their middles is the
  // curvature across the edge.
  void bend_surface(const Edge& edge, const std::vector<std::size_t>& triangles)
  {
    if (triangles.size() != 2 || std::ranges::binary_search(surface_.edges, edge)) return;
    std::array<Vec3, 2> normals{};
    double heights = 0.0;
    for (std::size_t side = 0; side < 2; ++side) {
      const auto corners = surface_.corners(triangles[side]);
      normals[side] = cross(corners[1] - corners[0], corners[2] - corners[0]);
      heights += norm(normals[side]) / length(edge);
    }
    const double turn = angle_between(normals[0], normals[1]);
    if (turn < kLeastTurn || heights < kFlat * length(edge)) return;
    const double radius = 0.5 * heights / turn;
    for (const LocalIndex v : edge) {
      restrict(v, radius / options_.curvature);
      radii_[at(v)] = std::min(radii_[at(v)], radius);
    }
  }

  void bend_and_shorten_curves()
  {
    std::map<std::pair<LocalIndex, LocalIndex>, std::vector<LocalIndex>> next;  // curve, vertex
    std::map<LocalIndex, double> lengths;
    for (std::size_t e = 0; e < surface_.edges.size(); ++e) {
      const auto [a, b] = surface_.edges[e];
      const LocalIndex curve = surface_.edge_curve[e];
      next[{curve, a}].push_back(b);
      next[{curve, b}].push_back(a);
      lengths[curve] += length(surface_.edges[e]);
    }
    std::map<LocalIndex, bool> is_loop;
    for (const auto& [place, others] : next) {
      const bool goes_on = others.size() == 2;
      is_loop.try_emplace(place.first, true).first->second &= goes_on;
      if (goes_on) bend_curve(place.second, others);
    }
    for (const auto& [place, others] : next) {
      const double least_edges = is_loop[place.first] ? kEdgesOfLoop : 1.0;
      restrict(place.second, lengths[place.first] / least_edges);
    }
  }

  void bend_curve(LocalIndex v, const std::vector<LocalIndex>& others)
  {
    const Vec3 to = xyz(v) - xyz(others[0]);
    const Vec3 from = xyz(others[1]) - xyz(v);
    const double turn = angle_between(to, from);
    if (turn < kLeastTurn || surface_.vertex_is_fixed[at(v)] != 0) return;
    restrict(v, 0.5 * (norm(to) + norm(from)) / turn / options_.curvature);
  }

  void resolve_round_places()
  {
    if (is_left_out(Repair::round_places)) return;
    const double least = kLeastSize * options_.max_size;
    std::vector<std::vector<std::size_t>> triangles(sizes_.size());
    for (std::size_t t = 0; t < surface_.triangles.size(); ++t) {
      for (const LocalIndex v : surface_.triangles[t]) {
        if (radii_[at(v)] < least) triangles[at(v)].push_back(t);
      }
    }
    RoundFinder round(surface_, edge_triangles_);
    for (std::size_t v = 0; v < sizes_.size(); ++v) {
      if (!round.goes_round(v, radii_[v], triangles[v])) continue;
      const double size = std::max(radii_[v], kLeastOfRound * options_.max_size);
      if (size >= sizes_[v]) continue;
      sizes_[v] = size;
      note_repair(Repair::round_places);
    }
  }

  const PatchSurface& surface_;
  const CoarseOptions& options_;
  std::vector<double> sizes_;
  std::vector<double> radii_;  // Of the surface at each vertex, however small.
  std::map<Edge, std::vector<std::size_t>> edge_triangles_;
};

}  // namespace

// Smallest sizes first; what they allow their neighbours is final when these are taken.
void grade(std::span<const Vec3> vertex_xyz, const Neighbours& neighbours, double grading,
           std::vector<double>& sizes)
{
  using Entry = std::pair<double, LocalIndex>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  for (std::size_t v = 0; v < sizes.size(); ++v) {
    queue.emplace(sizes[v], static_cast<LocalIndex>(v));
  }
  while (!queue.empty()) {
    const auto [size, v] = queue.top();
    queue.pop();
    if (size > sizes[at(v)]) continue;
    for (const LocalIndex other : neighbours[at(v)]) {
      const double apart = norm(vertex_xyz[at(other)] - vertex_xyz[at(v)]);
      const double allowed = size + grading * apart;
      if (allowed >= sizes[at(other)]) continue;
      sizes[at(other)] = allowed;
      queue.emplace(allowed, other);
    }
  }
}

std::vector<double> finer_sizes(const PatchSurface& surface,
                                const std::vector<std::size_t>& triangles, double grading)
{
  const Neighbours neighbours = neighbours_of(surface, triangles_by_edge(surface));
  std::vector<double> sizes(surface.vertex_xyz.size(), 0.0);
  for (std::size_t v = 0; v < sizes.size(); ++v) {
    for (const LocalIndex other : neighbours[v]) {
      const double length = norm(surface.vertex_xyz[at(other)] - surface.vertex_xyz[v]);
      sizes[v] += length / static_cast<double>(neighbours[v].size());
    }
  }
  const std::vector<double> before = sizes;
  for (const std::size_t t : triangles) {
    for (const LocalIndex v : surface.triangles[t]) sizes[at(v)] = 0.5 * before[at(v)];
  }
  grade(surface.vertex_xyz, neighbours, grading, sizes);
  return sizes;
}

std::vector<double> surface_sizes(const PatchSurface& surface, const CoarseOptions& options)
{
  return SizeField(surface, options).run();
}

}  // namespace tessera::coarse
