// SPDX-License-Identifier: BSD-3-Clause
#include "coarse/editable_surface.hpp"

#include <algorithm>
#include <utility>

namespace tessera::coarse {
namespace {

using Edge = EditableSurface::Edge;
using Triangle = EditableSurface::Triangle;

}  // namespace

EditableSurface::EditableSurface(const PatchSurface& surface, std::vector<double> sizes)
    : xyz_(surface.vertex_xyz),
      sizes_(std::move(sizes)),
      triangles_(surface.triangles),
      patch_(surface.triangle_patch),
      around_(surface.vertex_xyz.size())
{
  for (std::size_t t = 0; t < triangles_.size(); ++t) {
    for (const LocalIndex v : triangles_[t]) around_[at(v)].push_back(static_cast<LocalIndex>(t));
  }
  std::vector<std::vector<LocalIndex>> curves_of(xyz_.size());
  for (std::size_t e = 0; e < surface.edges.size(); ++e) {
    // A tessellation may drop a sliver between two pieces of a curve, and one of them with it.
    if (!has_edge(surface.edges[e][0], surface.edges[e][1])) continue;
    curves_[surface.edges[e]] = surface.edge_curve[e];
    for (const LocalIndex v : surface.edges[e]) {
      curves_of[at(v)].push_back(surface.edge_curve[e]);
    }
  }
  for (std::size_t v = 0; v < xyz_.size(); ++v) {
    const std::vector<LocalIndex>& curves = curves_of[v];
    const bool goes_on = curves.size() == 2 && curves[0] == curves[1];
    const bool is_fixed = surface.vertex_is_fixed[v] != 0 || !(curves.empty() || goes_on);
    freedom_.push_back(is_fixed ? Freedom::none : curves.empty() ? Freedom::patch : Freedom::curve);
  }
}

std::vector<LocalIndex> EditableSurface::triangles_at(const Edge& edge) const
{
  std::vector<LocalIndex> found;
  found.reserve(2);
  for (const LocalIndex t : around_[at(edge[0])]) {
    if (holds(triangles_[at(t)], edge[1])) found.push_back(t);
  }
  return found;
}

std::vector<LocalIndex> EditableSurface::neighbours(LocalIndex v) const
{
  std::vector<LocalIndex> found;
  found.reserve(around_[at(v)].size() + 1);
  for (const LocalIndex t : around_[at(v)]) {
    for (const LocalIndex other : triangles_[at(t)]) {
      if (other != v) add_if_new(other, found);
    }
  }
  std::ranges::sort(found);
  return found;
}

bool EditableSurface::has_edge(LocalIndex a, LocalIndex b) const
{
  return std::ranges::any_of(around_[at(a)],
                             [&](LocalIndex t) { return holds(triangles_[at(t)], b); });
}

LocalIndex EditableSurface::curve(LocalIndex a, LocalIndex b) const
{
  if (std::min(freedom(a), freedom(b)) == Freedom::patch) return kNoIndex;
  const auto found = curves_.find(edge_of(a, b));
  return found == curves_.end() ? kNoIndex : found->second;
}

std::vector<LocalIndex> EditableSurface::curve_neighbours(LocalIndex v) const
{
  std::vector<LocalIndex> found = neighbours(v);
  std::erase_if(found, [&](LocalIndex other) { return curve(v, other) == kNoIndex; });
  return found;
}

std::array<Vec3, 3> EditableSurface::corners_from(LocalIndex t, LocalIndex first) const
{
  std::array<Vec3, 3> p = corners(t);
  const auto at_first = std::ranges::find(triangles_[at(t)], first) - triangles_[at(t)].begin();
  std::ranges::rotate(p, p.begin() + at_first);
  return p;
}

Vec3 EditableSurface::middle_of_neighbours(LocalIndex v) const
{
  const std::vector<LocalIndex> around =
      freedom(v) == Freedom::curve ? curve_neighbours(v) : neighbours(v);
  Vec3 sum{};
  for (const LocalIndex other : around) sum = sum + xyz(other);
  return (1.0 / static_cast<double>(around.size())) * sum;
}

void EditableSurface::detach(LocalIndex t, LocalIndex v)
{
  std::vector<LocalIndex>& around = around_[at(v)];
  around.erase(std::ranges::find(around, t));
}

void EditableSurface::replace(LocalIndex t, LocalIndex old, LocalIndex by)
{
  triangles_[at(t)] = replaced(triangles_[at(t)], old, by);
  detach(t, old);
  around_[at(by)].push_back(t);
}

LocalIndex EditableSurface::split(const Edge& edge, const Vec3& xyz)
{
  const LocalIndex middle = num_vertices();
  const auto [a, b] = edge;
  xyz_.push_back(xyz);
  sizes_.push_back(0.5 * (size(a) + size(b)));
  around_.emplace_back();
  for (const LocalIndex t : triangles_at(edge)) {
    const auto second = static_cast<LocalIndex>(triangles_.size());
    triangles_.push_back(replaced(triangles_[at(t)], a, middle));
    patch_.push_back(patch_[at(t)]);
    for (const LocalIndex v : triangles_.back()) around_[at(v)].push_back(second);
    replace(t, b, middle);
  }
  const LocalIndex on = curve(a, b);
  freedom_.push_back(on == kNoIndex ? Freedom::patch : Freedom::curve);
  if (on == kNoIndex) return middle;
  curves_.erase(edge);
  curves_[edge_of(a, middle)] = on;
  curves_[edge_of(middle, b)] = on;
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
  // Only the triangles at the edge may have both as neighbours (the link condition).
  std::vector<LocalIndex> opposites;
  for (const LocalIndex t : triangles_at({gone, kept})) {
    opposites.push_back(opposite(triangles_[at(t)], {gone, kept}));
  }
  std::ranges::sort(opposites);
  const std::vector<LocalIndex> of_gone = neighbours(gone);
  const std::vector<LocalIndex> of_kept = neighbours(kept);
  std::vector<LocalIndex> common;
  std::ranges::set_intersection(of_gone, of_kept, std::back_inserter(common));
  return common == opposites;
}

void EditableSurface::collapse(LocalIndex gone, LocalIndex kept)
{
  if (freedom(gone) != Freedom::patch) {
    for (const LocalIndex other : curve_neighbours(gone)) {
      const LocalIndex on = curve(gone, other);
      curves_.erase(edge_of(gone, other));
      if (other == kept) continue;
      const auto [place, is_new] = curves_.try_emplace(edge_of(other, kept), on);
      if (!is_new) place->second = std::min(place->second, on);
    }
  }
  freedom_[at(kept)] = std::max(freedom(kept), freedom(gone));
  const std::vector<LocalIndex> around = around_[at(gone)];
  for (const LocalIndex t : around) {
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
  for (const LocalIndex t : around_[at(edge[0])]) {
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
    for (const LocalIndex v : triangle(t)) around_[at(v)].push_back(t);
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
  for (const auto& [edge, curve] : curves_) {
    result.edges.push_back({numbers[at(edge[0])], numbers[at(edge[1])]});
    result.edge_curve.push_back(curve);
  }
  return result;
}

}  // namespace tessera::coarse
