// SPDX-License-Identifier: BSD-3-Clause
#include "netgen/csg/triangles.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <set>
#include <utility>

#include "tessera/base/error.hpp"
#include "tessera/base/triangle.hpp"
#include "tessera/base/union_find.hpp"

#include "netgen/csg/access.hpp"
#include "netgen/csg/tree.hpp"

namespace tessera::netgen {
namespace {

using surface::PatchSurface;
using Geometry = ::netgen::CSGeometry;
using Edge = PatchSurface::Edge;

// Parts of the box diagonal: rounding of OpenCASCADE's intersections, and their largest tolerance.
constexpr double kOnSurface = 1e-6;
constexpr double kMostOff = 1e-3;
// NETGEN's box is that of triangles for pictures.
constexpr double kMostOffBox = 0.05;
// Points on both sides of a triangle, in parts of its size. In narrow places, and where chords cut
// corners, some are in the wrong solid.
constexpr double kBeside = 1e-3;
constexpr double kLeastShare = 0.9;

// Where a curve, or a surface around a point, turns by more (45 degrees), it has a corner there.
// Triangles of a smooth one turn by a fifth of that.
constexpr double kLeastSmoothCosine = 0.7;

constexpr const char* kNotTheSolids = "OpenCASCADE makes other solids of the file than NETGEN";

class Triangles {
 public:
  Triangles(PatchSurface surface, const Geometry& geometry, const ::netgen::Box<3>& box)
      : surface_(std::move(surface)), geometry_(geometry), box_(box)
  {
  }

  CsgTriangles run()
  {
    require_box();
    find_surfaces();
    find_solids();
    number_patches();
    number_curves();
    join_curves();
    surface_.edge_t.clear();
    surface_.triangle_uv.clear();
    made_.cad.triangles = std::move(surface_);
    return std::move(made_);
  }

 private:
  struct Corners {
    Vec3 a{}, b{}, c{};
    [[nodiscard]] Vec3 centre() const { return middle_of({a, b, c}); }
    [[nodiscard]] Vec3 normal() const { return unit_normal_of({a, b, c}); }
    [[nodiscard]] double size() const { return std::sqrt(triangle_area(a, b, c)); }
  };

  [[nodiscard]] Corners corners(std::size_t t) const
  {
    const auto [a, b, c] = surface_.corners(t);
    return {a, b, c};
  }

  void require_box() const
  {
    ::netgen::Box<3> found(::netgen::Box<3>::EMPTY_BOX);
    for (const auto& triangle : surface_.triangles) {
      for (const LocalIndex v : triangle) found.Add(to_netgen(surface_.vertex_xyz[at(v)]));
    }
    const double most = kMostOffBox * box_.Diam();
    const bool is_same = ::netgen::Dist(found.PMin(), box_.PMin()) <= most
                         && ::netgen::Dist(found.PMax(), box_.PMax()) <= most;
    if (!is_same) throw NetgenError(kNotTheSolids);
  }

  // Largest distance of corners, and sum of those of centres: three corners of a disc lie on the
  // cylinder around it as well. Of a surface that is too far it is the distance that says so.
  struct Fit {
    double corners = 0.0;
    double centres = 0.0;
  };

  [[nodiscard]] Fit fit_of(const std::vector<std::size_t>& triangles, int surface) const
  {
    Fit fit;
    for (const std::size_t t : triangles) {
      const Corners triangle = corners(t);
      for (const Vec3& p : {triangle.a, triangle.b, triangle.c}) {
        fit.corners = std::max(fit.corners, distance_to(surface, p));
      }
      if (!(fit.corners <= kMostOff * box_.Diam())) return fit;
      fit.centres += distance_to(surface, triangle.centre());
    }
    return fit;
  }

  [[nodiscard]] double distance_to(int surface, const Vec3& point) const
  {
    const double off = netgen::distance(*geometry_.GetSurface(surface), to_netgen(point));
    return std::isnan(off) ? std::numeric_limits<double>::infinity() : off;
  }

  [[nodiscard]] LocalIndex surface_of(const std::vector<std::size_t>& triangles) const
  {
    std::map<LocalIndex, Fit> fits;
    double nearest = std::numeric_limits<double>::infinity();
    for (int s = 0; s < geometry_.GetNSurf(); ++s) {
      if (geometry_.GetSurfaceClassRepresentant(s) != s) continue;
      const Fit& fit = fits[s] = fit_of(triangles, s);
      nearest = std::min(nearest, fit.corners);
    }
    if (!(nearest <= kMostOff * box_.Diam())) throw NetgenError(kNotTheSolids);
    const double as_near = std::max(10.0 * nearest, kOnSurface * box_.Diam());
    std::erase_if(fits, [&](const auto& one) { return one.second.corners > as_near; });
    return std::ranges::min_element(fits, {}, [](const auto& one) { return one.second.centres; })
        ->first;
  }

  void find_surfaces()
  {
    std::vector<std::vector<std::size_t>> triangles(at(surface_.num_patches()));
    for (std::size_t t = 0; t < surface_.triangles.size(); ++t) {
      triangles[at(surface_.triangle_patch[t])].push_back(t);
    }
    for (const auto& patch : triangles) {
      face_surface_.push_back(patch.empty() ? kNoIndex : surface_of(patch));
    }
  }

  [[nodiscard]] LocalIndex surface_at(std::size_t t) const
  {
    return face_surface_[at(surface_.triangle_patch[t])];
  }

  // How many points of a body, or of the outside, are in which solid; the last: in none.
  using Votes = std::vector<std::vector<int>>;

  [[nodiscard]] Votes votes() const
  {
    LocalIndex num_bodies = 0;
    for (const auto& [below, above] : surface_.patch_materials) {
      num_bodies = std::max({num_bodies, below, above});
    }
    const auto num_objects = at(geometry_.GetNTopLevelObjects());
    Votes all(at(num_bodies) + 1, std::vector<int>(num_objects + 1, 0));
    for (std::size_t t = 0; t < surface_.triangles.size(); ++t) {
      const Corners triangle = corners(t);
      ::netgen::Point<3> on = to_netgen(triangle.centre());
      geometry_.GetSurface(surface_at(t))->Project(on);
      const Vec3 step = kBeside * triangle.size() * triangle.normal();
      const auto [below, above] = surface_.patch_materials[at(surface_.triangle_patch[t])];
      ++all[at(below)][object_at(from_netgen(on) - step)];
      ++all[at(above)][object_at(from_netgen(on) + step)];
    }
    return all;
  }

  [[nodiscard]] std::size_t object_at(const Vec3& point) const
  {
    const double tolerance = std::numeric_limits<double>::epsilon() * box_.Diam();
    const int num_objects = geometry_.GetNTopLevelObjects();
    for (int i = 0; i < num_objects; ++i) {
      auto* const object = geometry_.GetTopLevelObject(i);
      if (object->GetSurface() != nullptr) continue;
      if (place_of(to_netgen(point), *object->GetSolid(), tolerance) != Place::outside) {
        return at(i);
      }
    }
    return at(num_objects);
  }

  void find_solids()
  {
    const Votes all = votes();
    std::set<LocalIndex> found;
    for (std::size_t body = 0; body < all.size(); ++body) {
      const auto most = std::ranges::max_element(all[body]);
      const int sum = std::accumulate(all[body].begin(), all[body].end(), 0);
      const auto object = static_cast<LocalIndex>(most - all[body].begin());
      const bool is_outside = object == geometry_.GetNTopLevelObjects();
      if (sum == 0 || *most < kLeastShare * sum || is_outside != (body == 0)) {
        throw NetgenError(kNotTheSolids);
      }
      if (body > 0) made_.body_object.push_back(object);
      found.insert(object);
    }
    for (int i = 0; i < geometry_.GetNTopLevelObjects(); ++i) {
      const bool is_solid = geometry_.GetTopLevelObject(i)->GetSurface() == nullptr;
      if (is_solid && !found.contains(i)) throw NetgenError(kNotTheSolids);
      made_.cad.solid_names.push_back(name_of_solid(geometry_, i));
    }
  }

  // A patch is a surface between two bodies, or outside of one. All its triangles are seen from the
  // same one of both.
  void number_patches()
  {
    using Key = std::array<LocalIndex, 3>;
    std::vector<Key> keys;
    std::map<Key, LocalIndex> patches;
    for (std::size_t t = 0; t < surface_.triangles.size(); ++t) {
      const auto [below, above] = surface_.patch_materials[at(surface_.triangle_patch[t])];
      if (below < above) std::swap(surface_.triangles[t][1], surface_.triangles[t][2]);
      keys.push_back({surface_at(t), std::max(below, above), std::min(below, above)});
      patches[keys.back()] = 0;
    }
    surface_.patch_materials.clear();
    for (auto& [key, patch] : patches) {
      patch = surface_.num_patches();
      surface_.patch_materials.push_back({key[1], key[2]});
      made_.cad.patch_surface.push_back(key[0]);
    }
    for (std::size_t t = 0; t < keys.size(); ++t) surface_.triangle_patch[t] = patches[keys[t]];
  }

  // Between two triangles of one patch there is none.
  void number_curves()
  {
    std::map<Edge, std::vector<LocalIndex>> patches;
    for (const Edge& edge : surface_.edges) patches[edge];
    for (std::size_t t = 0; t < surface_.triangles.size(); ++t) {
      for (std::size_t c = 0; c < 3; ++c) {
        const auto [low, high] =
            std::minmax(surface_.triangles[t][c], surface_.triangles[t][(c + 1) % 3]);
        const auto found = patches.find({low, high});
        if (found != patches.end()) found->second.push_back(surface_.triangle_patch[t]);
      }
    }
    surface_.edges.clear();
    surface_.edge_curve.clear();
    for (const auto& [edge, beside] : patches) {
      if (beside.empty() || (beside.size() == 2 && beside[0] == beside[1])) continue;
      std::set<LocalIndex> surfaces;
      for (const LocalIndex patch : beside) surfaces.insert(made_.cad.patch_surface[at(patch)]);
      surface_.edges.push_back(edge);
      surface_.edge_curve.push_back(curve_of(
          surfaces, midpoint(surface_.vertex_xyz[at(edge[0])], surface_.vertex_xyz[at(edge[1])])));
    }
  }

  // Where more than two surfaces meet, those that cross most steeply. Bodies may meet on one.
  [[nodiscard]] LocalIndex curve_of(const std::set<LocalIndex>& surfaces, const Vec3& point) const
  {
    LocalIndex curve = kNoIndex;
    double steepest = -1.0;
    for (auto a = surfaces.begin(); a != surfaces.end(); ++a) {
      for (auto b = std::next(a); b != surfaces.end(); ++b) {
        const double steep = norm(cross(normal_of_surface(geometry_, *a, point),
                                        normal_of_surface(geometry_, *b, point)));
        if (steep <= steepest) continue;
        steepest = steep;
        curve = *a * static_cast<LocalIndex>(geometry_.GetNSurf()) + *b;
      }
    }
    return curve;
  }

  // Gives pieces that go on smoothly in each other one number, and frees the vertices on their way.
  void join_curves()
  {
    std::vector<std::vector<std::size_t>> edges(surface_.vertex_xyz.size());
    for (std::size_t e = 0; e < surface_.edges.size(); ++e) {
      for (const LocalIndex v : surface_.edges[e]) edges[at(v)].push_back(e);
    }
    UnionFind pieces(static_cast<LocalIndex>(surface_.edges.size()));
    const std::vector<char> is_pointed = pointed_vertices();
    for (std::size_t v = 0; v < edges.size(); ++v) {
      const bool goes_on = edges[v].size() == 2 && is_smooth(edges[v][0], edges[v][1]);
      if (goes_on)
        pieces.join(static_cast<LocalIndex>(edges[v][0]), static_cast<LocalIndex>(edges[v][1]));
      const bool is_inside = edges[v].empty() && is_pointed[v] == 0;
      surface_.vertex_is_fixed[v] = goes_on || is_inside ? 0 : 1;
    }
    std::map<LocalIndex, LocalIndex> rows;
    for (std::size_t e = 0; e < surface_.edges.size(); ++e) {
      const auto [row, is_new] = rows.try_emplace(pieces.find(static_cast<LocalIndex>(e)),
                                                  static_cast<LocalIndex>(rows.size()));
      if (is_new) made_.cad.curve_number.push_back(surface_.edge_curve[e]);
      surface_.edge_curve[e] = row->second;
    }
  }

  // Whether two edges that meet are of one curve, without a corner.
  [[nodiscard]] bool is_smooth(std::size_t e, std::size_t f) const
  {
    if (surface_.edge_curve[e] != surface_.edge_curve[f]) return false;
    const auto [a, b] = surface_.edges[e];
    const auto [c, d] = surface_.edges[f];
    const LocalIndex middle = a == c || a == d ? a : b;
    const Vec3& at_middle = surface_.vertex_xyz[at(middle)];
    const Vec3 to = unit(at_middle - surface_.vertex_xyz[at(a + b - middle)]);
    const Vec3 from = unit(surface_.vertex_xyz[at(c + d - middle)] - at_middle);
    return dot(to, from) > kLeastSmoothCosine;
  }

  // Those where the surface is not smooth, as at the apex of a cone.
  [[nodiscard]] std::vector<char> pointed_vertices() const
  {
    std::vector<char> is_pointed(surface_.vertex_xyz.size(), 0);
    for (std::size_t t = 0; t < surface_.triangles.size(); ++t) {
      const LocalIndex surface = made_.cad.patch_surface[at(surface_.triangle_patch[t])];
      const Vec3 normal = corners(t).normal();
      for (const LocalIndex v : surface_.triangles[t]) {
        if (surface_.vertex_is_fixed[at(v)] == 0) continue;
        const double cosine =
            dot(normal, normal_of_surface(geometry_, surface, surface_.vertex_xyz[at(v)]));
        if (!(std::abs(cosine) > kLeastSmoothCosine)) is_pointed[at(v)] = 1;
      }
    }
    return is_pointed;
  }

  PatchSurface surface_;
  const Geometry& geometry_;
  const ::netgen::Box<3>& box_;
  std::vector<LocalIndex> face_surface_{};  // Of OpenCASCADE's faces; kNoIndex: without triangles.
  CsgTriangles made_{};
};

}  // namespace

CsgTriangles triangles_of_csg(PatchSurface surface, const Geometry& geometry,
                              const ::netgen::Box<3>& box)
{
  return Triangles(std::move(surface), geometry, box).run();
}

}  // namespace tessera::netgen
