// SPDX-License-Identifier: BSD-3-Clause
#include "surface/editable_surface.hpp"

#include <algorithm>
#include <utility>

namespace tessera::surface {
namespace {

using Edge = EditableSurface::Edge;
using Triangle = EditableSurface::Triangle;

}  // namespace

EditableSurface::EditableSurface(const PatchSurface& surface, std::vector<double> sizes)
    : xyz_(surface.vertex_xyz),
      sizes_(std::move(sizes)),
      triangles_(surface.triangles),
      patch_(surface.triangle_patch),
      around_(surface.vertex_xyz.size()),
      curve_ends_(surface.vertex_xyz.size())
{
  for (std::size_t t = 0; t < triangles_.size(); ++t) {
    for (const LocalIndex v : triangles_[t]) around_[at(v)].add(static_cast<LocalIndex>(t));
  }
  for (std::size_t e = 0; e < surface.edges.size(); ++e) {
    const auto [a, b] = surface.edges[e];
    // A tessellation may drop a sliver between two pieces of a curve, and one of them with it.
    if (has_edge(a, b)) put_on_curve(a, b, surface.edge_curve[e]);
  }
  for (std::size_t v = 0; v < xyz_.size(); ++v) {
    const std::vector<CurveEnd>& ends = curve_ends_[v];
    const bool goes_on = ends.size() == 2 && ends[0].curve == ends[1].curve;
    const bool is_fixed = surface.vertex_is_fixed[v] != 0 || !(ends.empty() || goes_on);
    freedom_.push_back(is_fixed ? Freedom::none : ends.empty() ? Freedom::patch : Freedom::curve);
  }
}

std::vector<LocalIndex> EditableSurface::triangles_at(const Edge& edge) const
{
  std::vector<LocalIndex> found;
  found.reserve(2);
  for (const LocalIndex t : triangles_of(edge[0])) {
    if (holds(triangles_[at(t)], edge[1])) found.push_back(t);
  }
  return found;
}

std::vector<LocalIndex> EditableSurface::neighbours(LocalIndex v) const
{
  std::vector<LocalIndex> found;
  found.reserve(triangles_of(v).size() + 1);
  for (const LocalIndex t : triangles_of(v)) {
    for (const LocalIndex other : triangles_[at(t)]) {
      if (other != v) add_if_new(other, found);
    }
  }
  std::ranges::sort(found);
  return found;
}

bool EditableSurface::has_edge(LocalIndex a, LocalIndex b) const
{
  return std::ranges::any_of(triangles_of(a),
                             [&](LocalIndex t) { return holds(triangles_[at(t)], b); });
}

LocalIndex EditableSurface::curve(LocalIndex a, LocalIndex b) const
{
  if (freedom(a) == Freedom::patch) return kNoIndex;  // Most vertices: nothing is read of them.
  const auto found = std::ranges::find(curve_ends_[at(a)], b, &CurveEnd::vertex);
  return found == curve_ends_[at(a)].end() ? kNoIndex : found->curve;
}

std::vector<std::pair<Edge, LocalIndex>> EditableSurface::curves() const
{
  std::vector<std::pair<Edge, LocalIndex>> all;
  for (LocalIndex a = 0; a < num_vertices(); ++a) {
    for (const auto& [b, curve] : curve_ends_[at(a)]) {
      if (a < b) all.push_back({{a, b}, curve});
    }
  }
  return all;
}

std::vector<LocalIndex> EditableSurface::curve_neighbours(LocalIndex v) const
{
  std::vector<LocalIndex> found;
  for (const CurveEnd& end : curve_ends_[at(v)]) found.push_back(end.vertex);
  return found;
}

// Of two curves on one edge, the lower counts.
void EditableSurface::put_on_curve(LocalIndex a, LocalIndex b, LocalIndex curve)
{
  for (const auto& [from, to] : {std::pair(a, b), std::pair(b, a)}) {
    std::vector<CurveEnd>& ends = curve_ends_[at(from)];
    const auto place = std::ranges::lower_bound(ends, to, {}, &CurveEnd::vertex);
    if (place != ends.end() && place->vertex == to) {
      place->curve = std::min(place->curve, curve);
    } else {
      ends.insert(place, {to, curve});
    }
  }
}

void EditableSurface::take_off_curve(LocalIndex a, LocalIndex b)
{
  for (const auto& [from, to] : {std::pair(a, b), std::pair(b, a)}) {
    std::erase_if(curve_ends_[at(from)],
                  [gone = to](const CurveEnd& end) { return end.vertex == gone; });
  }
}

std::array<Vec3, 3> EditableSurface::corners_from(LocalIndex t, LocalIndex first) const
{
  std::array<Vec3, 3> p = corners(t);
  const auto at_first = std::ranges::find(triangles_[at(t)], first) - triangles_[at(t)].begin();
  std::rotate(p.begin(), p.begin() + at_first, p.end());
  return p;
}

Vec3 EditableSurface::middle_of_neighbours(LocalIndex v) const
{
  if (freedom(v) == Freedom::curve) {
    const std::vector<CurveEnd>& two = curve_ends_[at(v)];
    return midpoint(xyz(two.front().vertex), xyz(two.back().vertex));
  }
  // Within a patch every neighbour is a corner of two triangles.
  Vec3 sum{};
  for (const LocalIndex t : triangles_of(v)) {
    for (const LocalIndex other : triangles_[at(t)]) {
      if (other != v) sum = sum + xyz(other);
    }
  }
  return (0.5 / static_cast<double>(triangles_of(v).size())) * sum;
}

void EditableSurface::detach(LocalIndex t, LocalIndex v) { around_[at(v)].remove(t); }

void EditableSurface::replace(LocalIndex t, LocalIndex old, LocalIndex by)
{
  triangles_[at(t)] = replaced(triangles_[at(t)], old, by);
  detach(t, old);
  around_[at(by)].add(t);
}

LocalIndex EditableSurface::split(const Edge& edge, const Vec3& xyz)
{
  const LocalIndex middle = num_vertices();
  const auto [a, b] = edge;
  xyz_.push_back(xyz);
  sizes_.push_back(0.5 * (size(a) + size(b)));
  around_.emplace_back();
  curve_ends_.emplace_back();
  for (const LocalIndex t : triangles_at(edge)) {
    const auto second = static_cast<LocalIndex>(triangles_.size());
    triangles_.push_back(replaced(triangles_[at(t)], a, middle));
    patch_.push_back(patch_[at(t)]);
    for (const LocalIndex v : triangles_.back()) around_[at(v)].add(second);
    replace(t, b, middle);
  }
  const LocalIndex on = curve(a, b);
  freedom_.push_back(on == kNoIndex ? Freedom::patch : Freedom::curve);
  if (on == kNoIndex) return middle;
  take_off_curve(a, b);
  put_on_curve(a, middle, on);
  put_on_curve(middle, b, on);
  return middle;
}

bool EditableSurface::can_collapse(LocalIndex gone, LocalIndex kept) const
{
  if (freedom(gone) == Freedom::none) return false;
  if (freedom(gone) == Freedom::curve) {
    if (curve(gone, kept) == kNoIndex) return false;
    for (const LocalIndex other : curve_neighbours(gone)) {
      if (other != kept && has_edge(other, kept)) return false;
    }
  }
  // Only opposite corners of triangles at the edge may be neighbours of both, each of one triangle
  // (the link condition).
  const auto num_opposite_to = [&](LocalIndex other) {
    return std::ranges::count_if(triangles_of(gone), [&](LocalIndex t) {
      return holds(triangles_[at(t)], kept) && holds(triangles_[at(t)], other);
    });
  };
  return std::ranges::all_of(triangles_of(gone), [&](LocalIndex t) {
    return std::ranges::all_of(triangles_[at(t)], [&](LocalIndex other) {
      if (other == gone || other == kept) return true;
      return num_opposite_to(other) == (has_edge(other, kept) ? 1 : 0);
    });
  });
}

void EditableSurface::collapse(LocalIndex gone, LocalIndex kept)
{
  if (freedom(gone) != Freedom::patch) {
    for (const LocalIndex other : curve_neighbours(gone)) {
      const LocalIndex on = curve(gone, other);
      take_off_curve(gone, other);
      if (other != kept) put_on_curve(other, kept, on);
    }
  }
  freedom_[at(kept)] = std::max(freedom(kept), freedom(gone));
  const ShortList around = around_[at(gone)];
  for (const LocalIndex t : around.values()) {
    if (!holds(triangles_[at(t)], kept)) {
      replace(t, gone, kept);
      continue;
    }
    for (const LocalIndex v : triangles_[at(t)]) detach(t, v);
    triangles_[at(t)][0] = kNoIndex;
  }
}

std::optional<EditableSurface::Flip> EditableSurface::flipped(const Edge& edge) const
{
  Flip flip;
  std::size_t count = 0;
  for (const LocalIndex t : triangles_of(edge[0])) {
    if (!holds(triangles_[at(t)], edge[1])) continue;
    if (count == 2) return std::nullopt;
    flip.triangles[count++] = t;
  }
  if (count != 2 || curve(edge[0], edge[1]) != kNoIndex) return std::nullopt;
  const auto& [first, second] = flip.triangles;
  const LocalIndex c = opposite(triangle(first), edge);
  const LocalIndex d = opposite(triangle(second), edge);
  if (c == d || has_edge(c, d)) return std::nullopt;
  flip.made = {replaced(triangle(first), edge[0], d), replaced(triangle(second), edge[1], c)};
  return flip;
}

void EditableSurface::flip(const Flip& flip)
{
  for (std::size_t side = 0; side < 2; ++side) {
    const LocalIndex t = flip.triangles[side];
    for (const LocalIndex v : triangle(t)) detach(t, v);
    triangles_[at(t)] = flip.made[side];
    for (const LocalIndex v : triangle(t)) around_[at(v)].add(t);
  }
}

PatchSurface EditableSurface::take(const PatchSurface& given) const
{
  PatchSurface result;
  result.patch_materials = given.patch_materials;
  std::vector<LocalIndex> numbers(xyz_.size(), kNoIndex);
  for (LocalIndex v = 0; v < num_vertices(); ++v) {
    if (!is_vertex(v)) continue;
    numbers[at(v)] = static_cast<LocalIndex>(result.vertex_xyz.size());
    result.vertex_xyz.push_back(xyz(v));
    result.vertex_is_fixed.push_back(freedom(v) == Freedom::none ? 1 : 0);
  }
  for (std::size_t t = 0; t < triangles_.size(); ++t) {
    const Triangle& v = triangles_[t];
    if (v[0] == kNoIndex) continue;
    result.triangles.push_back({numbers[at(v[0])], numbers[at(v[1])], numbers[at(v[2])]});
    result.triangle_patch.push_back(patch_[t]);
  }
  // The order of numbers is kept, so edges stay ascending.
  for (const auto& [edge, curve] : curves()) {
    result.edges.push_back({numbers[at(edge[0])], numbers[at(edge[1])]});
    result.edge_curve.push_back(curve);
  }
  return result;
}

}  // namespace tessera::surface
