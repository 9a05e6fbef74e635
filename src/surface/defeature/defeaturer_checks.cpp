// SPDX-License-Identifier: BSD-3-Clause
// What a step of the Defeaturer must keep.
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <utility>

#include "surface/defeature/defeaturer.hpp"

namespace tessera::surface {
namespace {

using Corners = std::array<Vec3, 3>;

// A triangle may turn by 60 degrees, unless it is as narrow as what is merged.
constexpr double kLeastCosine = 0.5;

// Two triangles at an edge with a smaller angle between them are a fold: 30 degrees. So the rim of
// a plate stays, however thin it is; without it both sides would lie on each other.
constexpr double kFoldCosine = 0.866;

// A triangle of a narrow place is lower than this part of its longest side.
constexpr double kNarrow = 0.3;

int num_common(const PatchSurface::Triangle& a, const PatchSurface::Triangle& b)
{
  return static_cast<int>(std::ranges::count_if(a, [&](LocalIndex v) { return holds(b, v); }));
}

// Whether the direction points between the two sides that a triangle has at its first corner.
bool is_within(const Corners& p, const Vec3& direction)
{
  const Vec3 n = normal_of(p);
  return dot(n, cross(p[1] - p[0], direction)) > 0.0 && dot(n, cross(direction, p[2] - p[0])) > 0.0;
}

// Whether two triangles with one first corner lie back to back there.
bool lie_back_to_back(const Corners& a, const Corners& b)
{
  const Vec3 of_a = normal_of(a);
  const Vec3 of_b = normal_of(b);
  if (dot(of_a, of_b) >= -kFoldCosine * norm(of_a) * norm(of_b)) return false;
  const auto any_within = [](const Corners& p, const Corners& other) {
    const Vec3 first = other[1] - other[0];
    const Vec3 second = other[2] - other[0];
    return is_within(p, first) || is_within(p, second) || is_within(p, first + second);
  };
  return any_within(a, b) || any_within(b, a);
}

PatchSurface::Triangle sorted(PatchSurface::Triangle triangle)
{
  std::ranges::sort(triangle);
  return triangle;
}

}  // namespace

Defeaturer::Triangles Defeaturer::in_domain(std::span<const LocalIndex> triangles,
                                            LocalIndex domain) const
{
  Triangles found;
  for (const LocalIndex t : triangles) {
    const auto& [below, above] = start_.patch_materials[at(surface_.patch(t))];
    if (below == domain || above == domain) found.push_back(t);
  }
  return found;
}

// The other corners of triangles at a vertex, ascending.
std::vector<LocalIndex> Defeaturer::link_of(LocalIndex v, const Triangles& triangles) const
{
  std::set<LocalIndex> others;
  for (const LocalIndex t : triangles) {
    for (const LocalIndex corner : surface_.triangle(t)) {
      if (corner != v) others.insert(corner);
    }
  }
  return {others.begin(), others.end()};
}

// What is outside of all materials is a domain as well.
bool Defeaturer::keeps_domains_closed(LocalIndex gone, LocalIndex kept) const
{
  std::set<LocalIndex> domains;
  for (const LocalIndex t : surface_.triangles_of(gone)) {
    const auto& sides = start_.patch_materials[at(surface_.patch(t))];
    domains.insert(sides.begin(), sides.end());
  }
  return std::ranges::all_of(domains,
                             [&](LocalIndex domain) { return keeps_closed(domain, gone, kept); });
}

// The link condition, in the skin of a domain that has the first vertex.
bool Defeaturer::keeps_closed(LocalIndex domain, LocalIndex gone, LocalIndex kept) const
{
  const Triangles of_gone = in_domain(surface_.triangles_of(gone), domain);
  const Triangles of_kept = in_domain(surface_.triangles_of(kept), domain);
  if (of_kept.empty()) return true;
  std::vector<LocalIndex> opposites;
  for (const LocalIndex t : in_domain(surface_.triangles_at({gone, kept}), domain)) {
    opposites.push_back(opposite(t, {gone, kept}));
  }
  std::ranges::sort(opposites);
  std::vector<LocalIndex> common;
  std::ranges::set_intersection(link_of(gone, of_gone), link_of(kept, of_kept),
                                std::back_inserter(common));
  return opposites.size() == 2 && common == opposites && !makes_twins(gone, kept, of_gone);
}

// Whether two triangles would have the same corners.
bool Defeaturer::makes_twins(LocalIndex gone, LocalIndex kept, const Triangles& of_gone) const
{
  std::set<Triangle> of_kept;
  for (const LocalIndex t : surface_.triangles_of(kept)) {
    of_kept.insert(sorted(surface_.triangle(t)));
  }
  return std::ranges::any_of(of_gone, [&](LocalIndex t) {
    const Triangle& v = surface_.triangle(t);
    return !holds(v, kept) && of_kept.contains(sorted(replaced(v, gone, kept)));
  });
}

bool Defeaturer::is_sound(const Step& step)
{
  for (std::size_t i = 0; i < step.made.size(); ++i) {
    if (is_thin(step.from[i])) continue;
    const Vec3 before = normal_of(surface_.corners(step.from[i]));
    const Vec3 after = normal_of(step.made[i].corners);
    if (dot(before, after) <= kLeastCosine * norm(before) * norm(after)) return false;
  }
  return guard_.allows(step.old, step.made) && !folds(step) && !lays_sheets_together(step);
}

// Whether two triangles that had no common corner lie back to back at the one that they get, as
// those on both sides of a plate do when the edge between them goes.
bool Defeaturer::lays_sheets_together(const Step& step) const
{
  struct Sheet {
    Corners corners{};  // The first one is that corner.
    Triangle now{};
    Triangle before{};
  };
  std::vector<Sheet> sheets;
  const auto add = [&](Corners p, const Triangle& now, const Triangle& before) {
    const auto first = std::ranges::find(now, step.at) - now.begin();
    const bool is_narrow = height_of(p) <= std::min(tolerance_, kNarrow * longest_side(p));
    if (first == 3 || is_narrow) return;
    std::rotate(p.begin(), p.begin() + first, p.end());
    sheets.push_back({p, now, before});
  };
  for (std::size_t i = 0; i < step.made.size(); ++i) {
    add(step.made[i].corners, step.made[i].vertices, surface_.triangle(step.from[i]));
  }
  for (const LocalIndex t : surface_.triangles_of(step.at)) {
    const Triangle& v = surface_.triangle(t);
    if (std::ranges::find(step.old, t) == step.old.end()) add(surface_.corners(t), v, v);
  }
  for (std::size_t i = 0; i < sheets.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const bool is_new = num_common(sheets[i].before, sheets[j].before) == 0
                          && num_common(sheets[i].now, sheets[j].now) == 1;
      if (is_new && lie_back_to_back(sheets[i].corners, sheets[j].corners)) return true;
    }
  }
  return false;
}

// Whether triangles of a step would lie on each other or on a neighbour, and did not before.
bool Defeaturer::folds(const Step& step) const
{
  if (!has_fold(step.made, step.old)) return false;
  std::vector<PlacedTriangle> before;
  for (const LocalIndex t : step.old) before.push_back({surface_.triangle(t), surface_.corners(t)});
  return !has_fold(before, step.old);
}

bool Defeaturer::has_fold(std::span<const PlacedTriangle> some, const Triangles& old) const
{
  Wings wings;
  for (const PlacedTriangle& one : some) {
    for (std::size_t c = 0; c < 3; ++c) {
      const std::size_t a = (c + 1) % 3;
      const std::size_t b = (c + 2) % 3;
      const auto [low, high] = std::minmax(one.vertices[a], one.vertices[b]);
      wings[{low, high}].push_back(wing(one.corners[a], one.corners[b], one.corners[c]));
    }
  }
  add_wings_beside(old, wings);
  for (const auto& [edge, all] : wings) {
    for (std::size_t i = 0; i < all.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        const bool is_wide = std::min(norm(all[i]), norm(all[j])) > tolerance_;
        if (is_wide && dot(all[i], all[j]) > kFoldCosine * norm(all[i]) * norm(all[j])) return true;
      }
    }
  }
  return false;
}

// At the same edges, of triangles that stay.
void Defeaturer::add_wings_beside(const Triangles& old, Wings& wings) const
{
  for (auto& [edge, all] : wings) {
    for (const LocalIndex t : surface_.triangles_at(edge)) {
      if (std::ranges::find(old, t) != old.end()) continue;
      all.push_back(
          wing(surface_.xyz(edge[0]), surface_.xyz(edge[1]), surface_.xyz(opposite(t, edge))));
    }
  }
}

}  // namespace tessera::surface
