// SPDX-License-Identifier: BSD-3-Clause
#include "surface/defeature/defeaturer.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

namespace tessera::surface {
namespace {

constexpr int kRounds = 20;

// A vertex is held against a curve if it is no farther from the chord, in parts of the chord. A
// curve that turns by 60 degrees between its points leaves the chord by less.
constexpr double kMostBow = 0.15;

// Triangles of which one side is as short as the tolerance have about this height.
constexpr double kThin = 2.0;

// In parts of the wanted edge length. The remesher collapses what is shorter than 0.83 of it.
constexpr double kSmall = 0.5;

std::vector<double> sizes_at(const std::vector<Vec3>& places, const MergeLimits& limits)
{
  std::vector<double> sizes(places.size(), std::numeric_limits<double>::infinity());
  if (limits.size_at) std::ranges::transform(places, sizes.begin(), limits.size_at);
  return sizes;
}

}  // namespace

Defeaturer::Defeaturer(const PatchSurface& start, const OnCurve& on_curve,
                       const MergeLimits& limits)
    : start_(start),
      on_curve_(on_curve),
      tolerance_(limits.most()),
      kept_(limits.kept),
      surface_(start, sizes_at(start.vertex_xyz, limits)),
      // A vertex may come to lie in an edge before it becomes a part of it.
      guard_(start, {kEverywhere}, AtRim::passes)
{
}

void Defeaturer::run()
{
  for (int round = 0; round < kRounds; ++round) {
    if (collapse_short_edges() + put_into_edges() + shorten_diagonals() == 0) return;
  }
}

std::vector<Vec3> Defeaturer::places() const
{
  std::set<LocalIndex> kept;
  for (const Merge& merge : merges_) kept.insert(merge.kept);
  std::vector<Vec3> found;
  for (const LocalIndex v : kept) {
    if (surface_.is_vertex(v)) found.push_back(surface_.xyz(v));
  }
  return found;
}

int Defeaturer::collapse_short_edges()
{
  std::vector<std::pair<double, Edge>> shortest;
  for (const Edge& edge : surface_.edges()) {
    const double small = std::max(small_at(edge[0]), small_at(edge[1]));
    if (length(edge) <= small) shortest.emplace_back(length(edge), edge);
  }
  std::ranges::sort(shortest);
  int count = 0;
  for (const auto& [was, edge] : shortest) {
    if (!surface_.has_edge(edge[0], edge[1])) continue;
    const auto [gone, kept] = gone_and_kept(edge);
    const bool is_even = surface_.freedom(gone) == surface_.freedom(kept);
    count += collapse(gone, kept) || (is_even && collapse(kept, gone)) ? 1 : 0;
  }
  return count;
}

// Of two that are bound alike, the one on the lower curve stays, as that will count.
Defeaturer::Edge Defeaturer::gone_and_kept(const Edge& edge) const
{
  const auto rank = [this](LocalIndex v) {
    LocalIndex lowest = kNoIndex;
    for (const LocalIndex other : surface_.curve_neighbours(v)) {
      const LocalIndex curve = surface_.curve(v, other);
      if (lowest == kNoIndex || curve < lowest) lowest = curve;
    }
    return std::tuple(surface_.freedom(v), -lowest, -v);
  };
  return rank(edge[0]) < rank(edge[1]) ? edge : Edge{edge[1], edge[0]};
}

// When its edge vanishes, or its corner across goes into the edge: its sides become one, or one and
// the halves of the other.
bool Defeaturer::may_vanish(LocalIndex t, const Edge& edge) const
{
  if (kept_.has_patch(surface_.patch(t))) return false;
  const LocalIndex across = opposite(t, edge);
  const std::array curves{surface_.curve(edge[0], edge[1]), surface_.curve(edge[0], across),
                          surface_.curve(edge[1], across)};
  return std::ranges::none_of(curves, [&](LocalIndex curve) { return kept_.has_curve(curve); });
}

bool Defeaturer::collapse(LocalIndex gone, LocalIndex kept)
{
  const Triangles at_edge = surface_.triangles_at({gone, kept});
  if (!std::ranges::all_of(at_edge, [&](LocalIndex t) { return may_vanish(t, {gone, kept}); }))
    return false;
  if (!may_go(gone, surface_.xyz(kept)) || !keeps_domains_closed(gone, kept)) return false;
  Step step{.at = kept, .old = surface_.copied_triangles_of(gone)};
  for (const LocalIndex t : step.old) {
    const Triangle& v = surface_.triangle(t);
    if (!holds(v, kept)) add(replaced(v, gone, kept), t, step);
  }
  if (!is_sound(step)) return false;
  surface_.collapse(gone, kept);
  update_guard(step.old);
  note({.gone = gone, .kept = kept});
  return true;
}

int Defeaturer::put_into_edges()
{
  int count = 0;
  for (const Cap& cap : find_caps()) count += put_into_edge(cap) ? 1 : 0;
  return count;
}

std::vector<Defeaturer::Cap> Defeaturer::find_caps() const
{
  std::vector<Cap> caps;
  for (const auto& [edge, curve] : surface_.curves()) {
    for (const LocalIndex t : surface_.triangles_at(edge)) {
      const LocalIndex v = opposite(t, edge);
      const Vec3& point = surface_.xyz(v);
      const double off_chord = norm(wing(surface_.xyz(edge[0]), surface_.xyz(edge[1]), point));
      if (off_chord > tolerance_ + kMostBow * length(edge)) continue;
      const double distance = norm(on_curve_(curve, edge[0], point) - point);
      if (distance <= small_at(v)) caps.push_back({distance, edge, v});
    }
  }
  std::ranges::sort(caps, {},
                    [](const Cap& cap) { return std::tuple(cap.distance, cap.edge, cap.v); });
  return caps;
}

bool Defeaturer::put_into_edge(const Cap& cap)
{
  const LocalIndex curve = surface_.curve(cap.edge[0], cap.edge[1]);
  if (curve == kNoIndex) return false;
  const Triangles at_edge = surface_.triangles_at(cap.edge);
  const auto t = std::ranges::find_if(
      at_edge, [&](LocalIndex one) { return opposite(one, cap.edge) == cap.v; });
  if (t == at_edge.end() || !may_vanish(*t, cap.edge) || is_tied(cap.edge, *t)) return false;
  // Since the cap was found, the vertex or the edge may have become one of another curve.
  const Vec3 on_curve = on_curve_(curve, cap.edge[0], surface_.xyz(cap.v));
  const Vec3 point = moves_onto(cap.v, curve) ? on_curve : surface_.xyz(cap.v);
  if (norm(point - on_curve) > tolerance_) return false;
  if (!is_between(cap.edge, point) || !may_go(cap.v, point)) return false;
  const Step step = step_into(cap.edge, *t, point);
  if (!is_sound(step)) return false;
  note({.gone = cap.v, .kept = cap.v, .curve_end = cap.edge[0]});
  origins_[cap.v].push_back(on_curve);  // That point of the curve goes where the vertex goes.
  split(cap.edge, cap.v, point);
  update_guard(step.old);
  return true;
}

// Puts the vertex opposite to an edge into it.
void Defeaturer::split(const Edge& edge, LocalIndex v, const Vec3& point)
{
  const LocalIndex beside = surface_.triangles_at(edge).front();
  const LocalIndex middle = surface_.split(edge, point);
  surface_.move(v, point);
  for (LocalIndex t = guard_.num_triangles(); t < surface_.num_triangles(); ++t) {
    guard_.add({surface_.triangle(t), surface_.corners(t)}, beside);
  }
  const Triangles changed = surface_.copied_triangles_of(middle);
  surface_.collapse(middle, v);
  update_guard(changed);
}

// Ends of curves stay, and points of the curve that will count.
bool Defeaturer::moves_onto(LocalIndex v, LocalIndex curve) const
{
  if (surface_.freedom(v) == Freedom::none) return false;
  return std::ranges::all_of(surface_.curve_neighbours(v),
                             [&](LocalIndex other) { return surface_.curve(v, other) > curve; });
}

bool Defeaturer::is_between(const Edge& edge, const Vec3& point) const
{
  const Vec3& a = surface_.xyz(edge[0]);
  const Vec3& b = surface_.xyz(edge[1]);
  const double part = dot(point - a, b - a);
  return part > 0.0 && part < dot(b - a, b - a) && norm(point - a) > tolerance_
         && norm(point - b) > tolerance_;
}

// Whether the cap's vertex is beside the edge in another way as well: the surface would be pinched.
bool Defeaturer::is_tied(const Edge& edge, LocalIndex cap) const
{
  const LocalIndex v = opposite(cap, edge);
  const auto& own = start_.patch_materials[at(surface_.patch(cap))];
  for (const LocalIndex t : surface_.triangles_at(edge)) {
    if (t == cap) continue;
    if (surface_.has_edge(opposite(t, edge), v)) return true;
    for (const LocalIndex domain : start_.patch_materials[at(surface_.patch(t))]) {
      if (domain == own[0] || domain == own[1]) continue;
      if (!in_domain(surface_.triangles_of(v), domain).empty()) return true;
    }
  }
  return false;
}

Defeaturer::Step Defeaturer::step_into(const Edge& edge, LocalIndex cap, const Vec3& point) const
{
  const LocalIndex v = opposite(cap, edge);
  Step step{.at = v, .old = surface_.copied_triangles_of(v)};
  for (const LocalIndex t : step.old) {
    if (t != cap) add(surface_.triangle(t), t, step);
  }
  for (const LocalIndex t : surface_.triangles_at(edge)) {
    if (t == cap) continue;
    step.old.push_back(t);
    for (const LocalIndex end : edge) add(replaced(surface_.triangle(t), end, v), t, step);
  }
  for (PlacedTriangle& one : step.made) {
    for (std::size_t c = 0; c < 3; ++c) {
      if (one.vertices[c] == v) one.corners[c] = point;
    }
  }
  return step;
}

// In a narrow patch, until vertices are opposite to the edges that they lie beside.
int Defeaturer::shorten_diagonals()
{
  int count = 0;
  for (const Edge& edge : surface_.edges()) count += shorten(edge) ? 1 : 0;
  return count;
}

bool Defeaturer::shorten(const Edge& edge)
{
  const auto flip = surface_.flipped(edge);
  if (!flip) return false;
  const Triangles two(flip->triangles.begin(), flip->triangles.end());
  if (!is_thin(two[0]) && !is_thin(two[1])) return false;
  if (length({opposite(two[0], edge), opposite(two[1], edge)}) >= length(edge)) return false;
  const Vec3 sum = normal_of(surface_.corners(two[0])) + normal_of(surface_.corners(two[1]));
  Step step{.old = two};
  for (std::size_t side = 0; side < 2; ++side) add(flip->made[side], two[side], step);
  const bool is_upright = std::ranges::all_of(
      step.made, [&](const PlacedTriangle& one) { return dot(normal_of(one.corners), sum) > 0.0; });
  if (!is_upright || !guard_.allows(step.old, step.made) || folds(step)) return false;
  surface_.flip(*flip);
  update_guard(two);
  return true;
}

double Defeaturer::small_at(LocalIndex v) const
{
  return std::min(tolerance_, kSmall * surface_.size(v));
}

double Defeaturer::length(const Edge& edge) const
{
  return norm(surface_.xyz(edge[1]) - surface_.xyz(edge[0]));
}

LocalIndex Defeaturer::opposite(LocalIndex t, const Edge& edge) const
{
  return surface::opposite(surface_.triangle(t), edge);
}

bool Defeaturer::is_thin(LocalIndex t) const
{
  return height_of(surface_.corners(t)) <= kThin * tolerance_;
}

void Defeaturer::add(const Triangle& v, LocalIndex from, Step& step) const
{
  step.made.push_back({v, {surface_.xyz(v[0]), surface_.xyz(v[1]), surface_.xyz(v[2])}});
  step.from.push_back(from);
}

// A vertex, and all that went into it, from where they were.
bool Defeaturer::may_go(LocalIndex v, const Vec3& point) const
{
  const auto is_near = [&](const Vec3& from) { return norm(from - point) <= tolerance_; };
  const auto merged = origins_.find(v);
  if (merged == origins_.end()) return is_near(surface_.xyz(v));
  return std::ranges::all_of(merged->second, is_near);
}

void Defeaturer::note(const Merge& merge)
{
  merges_.push_back(merge);
  std::vector<Vec3>& all = origins_[merge.kept];
  if (all.empty()) all.push_back(surface_.xyz(merge.kept));
  if (merge.gone == merge.kept) return;
  const auto more = origins_.find(merge.gone);
  if (more == origins_.end()) {
    all.push_back(surface_.xyz(merge.gone));
  } else {
    all.insert(all.end(), more->second.begin(), more->second.end());
  }
}

void Defeaturer::update_guard(const Triangles& triangles)
{
  for (const LocalIndex t : triangles) {
    if (surface_.is_triangle(t)) {
      guard_.change(t, {surface_.triangle(t), surface_.corners(t)});
    } else {
      guard_.remove(t);
    }
  }
}

}  // namespace tessera::surface
