// SPDX-License-Identifier: BSD-3-Clause
#include "surface/remesh/periodic_rims.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "tessera/base/error.hpp"
#include "tessera/base/triangle.hpp"
#include "tessera/mesh/tet_topology.hpp"
#include "tessera/model/point_search.hpp"

#include "surface/remesh/side_shift.hpp"

namespace tessera::surface {
namespace {

using Edge = PatchSurface::Edge;

// A curve is the image of another one if it is nowhere farther off than this part of its length:
// both are chords of arcs here.
constexpr double kMostOffCurve = 0.05;

// In parts of the shorter edge beside it: a vertex so near to an image goes there.
constexpr double kNearImage = 0.4;

// The same: it is there.
constexpr double kAtImage = 1e-3;

bool holds_patch(const std::vector<LocalIndex>& patches, LocalIndex patch)
{
  return std::ranges::find(patches, patch) != patches.end();
}

std::set<LocalIndex> vertices_on(const EditableSurface& surface, LocalIndex curve)
{
  std::set<LocalIndex> vertices;
  for (const auto& [edge, of_edge] : surface.curves()) {
    if (of_edge == curve) vertices.insert({edge[0], edge[1]});
  }
  return vertices;
}

// Lets one curve have the vertices that it is to have; lives for one step of match().
class CurveFollower {
 public:
  CurveFollower(SurfaceEditor& editor, LocalIndex curve)
      : editor_(editor),
        surface_(editor.surface()),
        curve_(curve),
        vertices_(vertices_on(surface_, curve))
  {
  }

  // Vertices that are near a place go there, others go into their neighbours.
  // @return Places of those that can do neither.
  std::vector<Vec3> follow(const std::vector<Vec3>& places)
  {
    is_taken_.assign(places.size(), false);
    std::set<LocalIndex> left = vertices_;
    for (const auto& [distance, v, place] : near_pairs(places)) {
      if (is_taken_[place] || !left.contains(v)) continue;
      is_taken_[place] = true;
      left.erase(v);
      if (surface_.freedom(v) == Freedom::curve) editor_.put_at(v, places[place]);
    }
    std::vector<Vec3> extra;
    for (const LocalIndex v : left) {
      if (!leave(v)) extra.push_back(surface_.xyz(v));
    }
    return extra;
  }

  // A vertex at each place that none is at since follow().
  void fill(const std::vector<Vec3>& places)
  {
    for (std::size_t i = 0; i < places.size(); ++i) {
      if (!is_taken_[i]) put_vertex(places[i]);
    }
  }

  // Where the curve is nearest; of one that was merged away there is nothing left to divide.
  void put_vertex(const Vec3& place)
  {
    double nearest = std::numeric_limits<double>::infinity();
    Edge at_place{};
    for (const auto& [edge, curve] : surface_.curves()) {
      if (curve != curve_) continue;
      const std::array<Vec3, 2> ends{surface_.xyz(edge[0]), surface_.xyz(edge[1])};
      const double off = norm(model::nearest_point_of(ends, place) - place);
      if (off >= nearest) continue;
      nearest = off;
      at_place = edge;
    }
    if (std::isinf(nearest)) return;
    const Vec3& a = surface_.xyz(at_place[0]);
    const Vec3 along = surface_.xyz(at_place[1]) - a;
    const double part = dot(place - a, along) / dot(along, along);
    editor_.put_at(editor_.split(at_place, std::clamp(part, kAtImage, 1.0 - kAtImage)), place);
  }

 private:
  struct NearPair {
    double distance = 0.0;
    LocalIndex vertex = kNoIndex;
    std::size_t place = 0;
    auto operator<=>(const NearPair&) const = default;
  };

  // Nearest first.
  [[nodiscard]] std::vector<NearPair> near_pairs(const std::vector<Vec3>& places) const
  {
    std::vector<NearPair> pairs;
    for (const LocalIndex v : vertices_) {
      const bool is_free = surface_.freedom(v) == Freedom::curve;
      const double most = (is_free ? kNearImage : kAtImage) * spacing(v);
      for (std::size_t i = 0; i < places.size(); ++i) {
        const double distance = norm(surface_.xyz(v) - places[i]);
        if (distance <= most) pairs.push_back({distance, v, i});
      }
    }
    std::ranges::sort(pairs);
    return pairs;
  }

  [[nodiscard]] double spacing(LocalIndex v) const
  {
    double shortest = std::numeric_limits<double>::infinity();
    for (const LocalIndex other : surface_.curve_neighbours(v)) {
      shortest = std::min(shortest, norm(surface_.xyz(other) - surface_.xyz(v)));
    }
    return shortest;
  }

  bool leave(LocalIndex v)
  {
    if (surface_.freedom(v) != Freedom::curve) return false;
    return std::ranges::any_of(surface_.curve_neighbours(v), [&](LocalIndex kept) {
      return editor_.collapse(v, kept, editor_.fair_shape(v));
    });
  }

  SurfaceEditor& editor_;
  const EditableSurface& surface_;
  LocalIndex curve_;
  std::set<LocalIndex> vertices_;  // That it has at first.
  std::vector<bool> is_taken_{};   // Of the places of follow().
};

// Curves of one orbit: its lowest, and the images of that.
struct CurveOrbit {
  LocalIndex base = kNoIndex;
  std::vector<std::pair<LocalIndex, Affine>> images{};
};

std::vector<Vec3> places_of(const EditableSurface& surface, LocalIndex curve, const Affine& there)
{
  std::vector<Vec3> places;
  for (const LocalIndex v : vertices_on(surface, curve)) {
    places.push_back(there(surface.xyz(v)));
  }
  return places;
}

void match_orbit(SurfaceEditor& editor, const CurveOrbit& orbit)
{
  const EditableSurface& surface = editor.surface();
  for (const auto& [curve, there] : orbit.images) {
    const auto extra = CurveFollower(editor, curve).follow(places_of(surface, orbit.base, there));
    CurveFollower base(editor, orbit.base);
    for (const Vec3& place : extra) base.put_vertex(there.inverse()(place));
  }
  for (const auto& [curve, there] : orbit.images) {
    const auto places = places_of(surface, orbit.base, there);
    CurveFollower follower(editor, curve);
    static_cast<void>(follower.follow(places));
    follower.fill(places);
    for (const LocalIndex v : vertices_on(surface, curve)) editor.fix(v);
  }
  for (const LocalIndex v : vertices_on(surface, orbit.base)) editor.fix(v);
}

// The vertex at a place, among some.
class VertexFinder {
 public:
  VertexFinder(const PatchSurface& surface, const std::set<LocalIndex>& vertices)
      : vertices_(vertices.begin(), vertices.end()),
        search_(model::search_of_points(places(surface, vertices)))
  {
  }

  [[nodiscard]] LocalIndex at_place(const Vec3& place, double tolerance) const
  {
    const model::NearestPoint nearest = search_.nearest(place);
    return norm(nearest.xyz - place) <= tolerance ? vertices_[at(nearest.simplex)] : kNoIndex;
  }

 private:
  static std::vector<Vec3> places(const PatchSurface& surface, const std::set<LocalIndex>& vertices)
  {
    std::vector<Vec3> places;
    for (const LocalIndex v : vertices) places.push_back(surface.vertex_xyz[at(v)]);
    return places;
  }

  std::vector<LocalIndex> vertices_;
  model::SegmentSearch search_;
};

std::vector<std::size_t> triangles_in(const PatchSurface& surface,
                                      const std::vector<LocalIndex>& patches)
{
  std::vector<std::size_t> triangles;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    if (holds_patch(patches, surface.triangle_patch[t])) triangles.push_back(t);
  }
  return triangles;
}

// Vertices of triangles that lie on curves.
std::set<LocalIndex> rim_of(const PatchSurface& surface, const std::vector<std::size_t>& triangles)
{
  std::set<LocalIndex> on_curves;
  for (const Edge& edge : surface.edges) on_curves.insert(edge.begin(), edge.end());
  std::set<LocalIndex> rim;
  for (const std::size_t t : triangles) {
    for (const LocalIndex v : surface.triangles[t]) {
      if (on_curves.contains(v)) rim.insert(v);
    }
  }
  return rim;
}

// Of each vertex of a side its image: on the rim a vertex that is there, else a new one.
std::map<LocalIndex, LocalIndex> vertices_of_image(PatchSurface& surface,
                                                   const std::vector<std::size_t>& from,
                                                   const std::vector<std::size_t>& to,
                                                   const Affine& there)
{
  const VertexFinder finder(surface, rim_of(surface, to));
  const std::set<LocalIndex> rim = rim_of(surface, from);
  std::map<LocalIndex, LocalIndex> image;
  for (const std::size_t t : from) {
    const auto corners = surface.corners(t);
    const double tolerance = kAtImage * norm(corners[1] - corners[0]);
    for (const LocalIndex v : surface.triangles[t]) {
      if (image.contains(v)) continue;
      const Vec3 place = there(surface.vertex_xyz[at(v)]);
      if (rim.contains(v)) {
        image[v] = finder.at_place(place, tolerance);
        if (image[v] != kNoIndex) continue;
        throw GeometryError(fmt::format(
            "[[periodic]]: the sides do not match: the curves around the other side have no point "
            "at ({:g}), which is the image of ({:g}); correct the entry's translation or rotation, "
            "or "
            "the model",
            fmt::join(place, ", "), fmt::join(surface.vertex_xyz[at(v)], ", ")));
      }
      image[v] = static_cast<LocalIndex>(surface.vertex_xyz.size());
      surface.vertex_xyz.push_back(place);
      surface.vertex_is_fixed.push_back(0);
    }
  }
  return image;
}

}  // namespace

PeriodicRims::PeriodicRims(const SurfaceReference& reference, const model::Model& model,
                           std::vector<PeriodicPatches> sides)
    : reference_(reference), sides_(std::move(sides))
{
  std::vector<Affine> transforms{Affine{}};
  std::vector<mesh::ImageLink> links;
  LocalIndex num_curves = 0;
  for (const LocalIndex curve : reference.surface().edge_curve) {
    num_curves = std::max(num_curves, curve + 1);
  }
  for (PeriodicPatches& side : sides_) {
    const bool is_translation = side.there.rows == Affine{}.rows;
    if (is_translation) {
      side.there.shift = shift_by_curves(reference, model, image_curves(side), side.there.shift);
    }
    for (const auto& [curve, image] : image_curves(side)) {
      if (image != curve) {
        links.push_back({curve, image, static_cast<LocalIndex>(transforms.size())});
      }
    }
    transforms.push_back(side.there);
  }
  curves_ = mesh::find_orbits(num_curves, links, transforms, images_);
}

std::vector<LocalIndex> PeriodicRims::curves_of(const std::vector<LocalIndex>& patches) const
{
  const PatchSurface& surface = reference_.surface();
  std::set<LocalIndex> curves;
  for (const std::size_t t : triangles_in(surface, patches)) {
    const auto& v = surface.triangles[t];
    for (std::size_t c = 0; c < 3; ++c) {
      const Edge edge = mesh::sorted_edge(v[c], v[(c + 1) % 3]);
      const auto found = std::ranges::lower_bound(surface.edges, edge);
      if (found == surface.edges.end() || *found != edge) continue;
      curves.insert(surface.edge_curve[static_cast<std::size_t>(found - surface.edges.begin())]);
    }
  }
  return {curves.begin(), curves.end()};
}

std::vector<std::array<LocalIndex, 2>> PeriodicRims::image_curves(const PeriodicPatches& side) const
{
  const std::vector<LocalIndex> candidates = curves_of(side.to);
  std::vector<std::array<LocalIndex, 2>> pairs;
  for (const LocalIndex curve : curves_of(side.from)) {
    const LocalIndex image = image_of_curve(curve, side.there, candidates);
    if (image != kNoIndex) pairs.push_back({curve, image});
  }
  return pairs;
}

LocalIndex PeriodicRims::image_of_curve(LocalIndex curve, const Affine& there,
                                        const std::vector<LocalIndex>& candidates) const
{
  const PatchSurface& surface = reference_.surface();
  std::vector<Vec3> samples;
  double length = 0.0;
  for (std::size_t e = 0; e < surface.edges.size(); ++e) {
    if (surface.edge_curve[e] != curve) continue;
    const Vec3& a = surface.vertex_xyz[at(surface.edges[e][0])];
    const Vec3& b = surface.vertex_xyz[at(surface.edges[e][1])];
    samples.insert(samples.end(), {there(a), there(midpoint(a, b)), there(b)});
    length += norm(b - a);
  }
  LocalIndex nearest = kNoIndex;
  double least = kMostOffCurve * length;
  for (const LocalIndex candidate : candidates) {
    double most = 0.0;
    for (const Vec3& sample : samples) {
      most = std::max(most, norm(reference_.on_curve(candidate, sample) - sample));
    }
    if (most >= least) continue;
    least = most;
    nearest = candidate;
  }
  return nearest;
}

// By where most of its triangles lie.
LocalIndex PeriodicRims::image_of_patch(LocalIndex patch, const PeriodicPatches& side) const
{
  const PatchSurface& surface = reference_.surface();
  LocalIndex nearest = side.to.front();
  double least = std::numeric_limits<double>::infinity();
  for (const LocalIndex candidate : side.to) {
    double off = 0.0;
    for (const std::size_t t : triangles_in(surface, {patch})) {
      const auto [a, b, c] = surface.corners(t);
      const Vec3 middle = side.there(middle_of({a, b, c}));
      off += triangle_area(a, b, c) * norm(reference_.on_patch(candidate, middle) - middle);
    }
    if (off >= least) continue;
    least = off;
    nearest = candidate;
  }
  return nearest;
}

std::vector<SizeSource> PeriodicRims::sizes_of_images(const PatchSurface& surface,
                                                      const SizeFunction& sizes) const
{
  std::vector<SizeSource> sources;
  const auto add = [&](const std::vector<LocalIndex>& patches, const Affine& there) {
    for (const std::size_t t : triangles_in(surface, patches)) {
      const auto [a, b, c] = surface.corners(t);
      sources.push_back({{there(a), there(b), there(c)}, sizes(middle_of({a, b, c}))});
    }
  };
  for (const PeriodicPatches& side : sides_) {
    add(side.from, side.there);
    add(side.to, side.there.inverse());
  }
  return sources;
}

void PeriodicRims::match(SurfaceEditor& editor) const
{
  std::map<LocalIndex, CurveOrbit> orbits;
  for (LocalIndex curve = 0; curve < static_cast<LocalIndex>(curves_.base.size()); ++curve) {
    const LocalIndex base = curves_.base_of(curve);
    if (base == curve) continue;
    orbits[base].base = base;
    orbits[base].images.emplace_back(curve, images_[at(curves_.image_of(curve))]);
  }
  editor.begin_pass();
  for (const auto& [base, orbit] : orbits) match_orbit(editor, orbit);
}

void PeriodicRims::copy_triangles(PatchSurface& surface) const
{
  for (const PeriodicPatches& side : sides_) {
    const std::vector<std::size_t> from = triangles_in(surface, side.from);
    const std::vector<std::size_t> to = triangles_in(surface, side.to);
    const auto image = vertices_of_image(surface, from, to, side.there);
    std::map<LocalIndex, LocalIndex> patch_of;
    for (const LocalIndex patch : side.from) patch_of[patch] = image_of_patch(patch, side);
    PatchSurface made{.patch_materials = surface.patch_materials};
    for (const std::size_t t : from) {
      const LocalIndex patch = patch_of.at(surface.triangle_patch[t]);
      auto v = surface.triangles[t];
      for (LocalIndex& corner : v) corner = image.at(corner);
      // What is outside of the one side is inside of the other one.
      const bool is_out_of = surface.patch_materials[at(surface.triangle_patch[t])][0] == 0;
      if ((surface.patch_materials[at(patch)][0] == 0) == is_out_of) std::swap(v[1], v[2]);
      made.triangles.push_back(v);
      made.triangle_patch.push_back(patch);
    }
    for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
      if (holds_patch(side.to, surface.triangle_patch[t])) continue;
      made.triangles.push_back(surface.triangles[t]);
      made.triangle_patch.push_back(surface.triangle_patch[t]);
    }
    surface.triangles = std::move(made.triangles);
    surface.triangle_patch = std::move(made.triangle_patch);
  }
}

}  // namespace tessera::surface
