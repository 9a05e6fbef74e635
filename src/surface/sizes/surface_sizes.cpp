// SPDX-License-Identifier: BSD-3-Clause
#include "surface/sizes/surface_sizes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "tessera/base/repair.hpp"
#include "tessera/mesh/tet_topology.hpp"

#include "surface/editable_surface.hpp"

namespace tessera::surface {
namespace {

using Edge = PatchSurface::Edge;

// Of the largest size: smaller radii and curves are not resolved. In models with defects, radii of
// nothing would make millions of triangles.
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

// Each edge with each of its triangles, ascending.
using EdgeTriangles = std::vector<std::pair<Edge, std::size_t>>;

EdgeTriangles triangles_by_edge(const PatchSurface& surface)
{
  EdgeTriangles triangles;
  triangles.reserve(3 * surface.triangles.size());
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const PatchSurface::Triangle& v = surface.triangles[t];
    for (std::size_t c = 0; c < 3; ++c)
      triangles.emplace_back(mesh::sorted_edge(v[c], v[(c + 1) % 3]), t);
  }
  std::ranges::sort(triangles);
  return triangles;
}

// Calls visit(edge, its triangles) for each edge, ascending.
template <class Visit>
void for_each_edge(const EdgeTriangles& all, const Visit& visit)
{
  std::vector<std::size_t> triangles;
  for (std::size_t row = 0; row < all.size(); ++row) {
    triangles.push_back(all[row].second);
    if (row + 1 < all.size() && all[row + 1].first == all[row].first) continue;
    visit(all[row].first, std::as_const(triangles));
    triangles.clear();
  }
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
    for_each_edge(edge_triangles, [this](const Edge&, const std::vector<std::size_t>& two) {
      if (two.size() != 2 || cosine(two[0], two[1]) <= kLeastSmoothCosine) return;
      beside_[two[0]].push_back(two[1]);
      beside_[two[1]].push_back(two[0]);
    });
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

class BentPlaces {
 public:
  BentPlaces(const PatchSurface& surface, const CoarseOptions& options)
      : surface_(surface),
        options_(options),
        radii_(surface.vertex_xyz.size(), kInfinity),
        edge_triangles_(triangles_by_edge(surface))
  {
  }

  std::vector<SizeSource> run() &&
  {
    for_each_edge(edge_triangles_,
                  [this](const Edge& edge, const std::vector<std::size_t>& triangles) {
                    bend_surface(edge, triangles);
                  });
    bend_and_shorten_curves();
    resolve_round_places();
    return std::move(sources_);
  }

 private:
  [[nodiscard]] const Vec3& xyz(LocalIndex v) const { return surface_.vertex_xyz[at(v)]; }
  [[nodiscard]] double length(const Edge& edge) const { return norm(xyz(edge[1]) - xyz(edge[0])); }

  void add(const Edge& edge, double size)
  {
    sources_.push_back({{xyz(edge[0]), xyz(edge[1]), xyz(edge[1])}, size});
  }

  void restrict(const Edge& edge, double size)
  {
    add(edge, std::max(kLeastSize * options_.max_size, size));
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
      normals[side] = normal_of(corners);
      heights += norm(normals[side]) / length(edge);
    }
    const double turn = angle_between(normals[0], normals[1]);
    if (turn < kLeastTurn || heights < kFlat * length(edge)) return;
    const double radius = 0.5 * heights / turn;
    restrict(edge, radius / options_.curvature);
    for (const LocalIndex v : edge) radii_[at(v)] = std::min(radii_[at(v)], radius);
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
    for (std::size_t e = 0; e < surface_.edges.size(); ++e) {
      const LocalIndex curve = surface_.edge_curve[e];
      restrict(surface_.edges[e], lengths[curve] / (is_loop[curve] ? kEdgesOfLoop : 1.0));
    }
  }

  void bend_curve(LocalIndex v, const std::vector<LocalIndex>& others)
  {
    const Vec3 to = xyz(v) - xyz(others[0]);
    const Vec3 from = xyz(others[1]) - xyz(v);
    const double turn = angle_between(to, from);
    if (turn < kLeastTurn || surface_.vertex_is_fixed[at(v)] != 0) return;
    const double size = 0.5 * (norm(to) + norm(from)) / turn / options_.curvature;
    for (const LocalIndex other : others) restrict({v, other}, size);
  }

  void resolve_round_places()
  {
    if (is_left_out(Repair::round_places)) return;
    const double least = kLeastSize * options_.max_size;
    std::vector<std::vector<std::size_t>> triangles(radii_.size());
    for (std::size_t t = 0; t < surface_.triangles.size(); ++t) {
      for (const LocalIndex v : surface_.triangles[t]) {
        if (radii_[at(v)] < least) triangles[at(v)].push_back(t);
      }
    }
    RoundFinder round(surface_, edge_triangles_);
    std::vector<char> is_round(radii_.size(), 0);
    for (std::size_t v = 0; v < radii_.size(); ++v) {
      is_round[v] = round.goes_round(v, radii_[v], triangles[v]) ? 1 : 0;
      if (is_round[v] != 0) note_repair(Repair::round_places);
    }
    for_each_edge(edge_triangles_, [&](const Edge& edge, const std::vector<std::size_t>&) {
      if (is_round[at(edge[0])] == 0 || is_round[at(edge[1])] == 0) return;
      const double radius = std::max(radii_[at(edge[0])], radii_[at(edge[1])]);
      add(edge, std::max(radius, kLeastOfRound * options_.max_size));
    });
  }

  const PatchSurface& surface_;
  const CoarseOptions& options_;
  std::vector<SizeSource> sources_{};
  std::vector<double> radii_;  // Of the surface at each vertex, however small.
  EdgeTriangles edge_triangles_;
};

}  // namespace

std::vector<SizeSource> bent_places_of(const PatchSurface& surface, const CoarseOptions& options)
{
  return BentPlaces(surface, options).run();
}

}  // namespace tessera::surface
