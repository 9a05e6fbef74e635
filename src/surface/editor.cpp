// SPDX-License-Identifier: BSD-3-Clause
#include "surface/editor.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "tessera/base/error.hpp"
#include "tessera/base/triangle.hpp"

#include "surface/angle_shape.hpp"
#include "surface/model_curve.hpp"

namespace tessera::surface {
namespace {

using Edge = SurfaceEditor::Edge;
using Triangle = SurfaceEditor::Triangle;

constexpr double kTurnedOver = -1.0;
constexpr double kUnknown = -2.0;

// A triangle whose normal is more than 60 degrees off the reference's is turned over or cuts a
// corner.
constexpr double kLeastCosine = 0.5;

// In wanted lengths: how far the middle of a triangle may be off the reference if its corners do
// not tell that it looks the right way. Without it vertices stayed at the axes of thin holes.
constexpr double kMostOffMiddle = 0.25;

// A new edge of a curve may leave the curve by this part of its length.
constexpr double kMostBow = 0.2;

// A vertex that moves along a curve may not make the arcs beside it rounder than 125 degrees, by
// the same measure. Else smoothing slides it past a bend, and edges there lie far off the curve: on
// a mount of 1,574 faces two vertices were 0.14 mm off. With 0.2, G of hammer.iges was 4 % larger.
constexpr double kMostBowOfMove = 0.3;

// Both parts of a split edge must be shorter than it by this part of the shorter one, or it would
// be split for ever: beside what was merged, edges lie beyond the faces of the reference, where all
// of an edge may be nearest to one of its ends.
constexpr double kLeastProgress = 0.2;

// In parts of the wanted length.
constexpr double kMostOffReference = 0.5;

// In wanted lengths: what a collapse makes too long is split again. With 1.4 the triangles of
// linkrods.step at 0.05 had a 1st percentile of 38.4 degrees, not 40.7; with no limit bearing.brep
// cut itself at 460 places.
constexpr double kMuchTooLong = 2.0;

// What is too long already may become longer by so much. So needles along a cylinder are joined
// before they are split along it: linkrods, screw and frame are remeshed in 0.8 of the time.
constexpr double kHardlyLonger = 1.1;

}  // namespace

SurfaceEditor::SurfaceEditor(const SurfaceReference& reference, const PatchSurface& start,
                             const SizeFunction& sizes, const model::Model* model,
                             std::vector<Box> guarded)
    : reference_(reference),
      surface_(start, std::vector<double>(start.vertex_xyz.size(), 0.0)),
      sizes_(sizes),
      model_(model),
      changed_(start.vertex_xyz.size(), 0),
      touched_(start.vertex_xyz.size(), 0),
      shapes_(start.triangles.size(), kUnknown),
      normals_(start.vertex_xyz.size())
{
  if (!guarded.empty()) guard_.emplace(start, std::move(guarded));
  for (LocalIndex v = 0; v < surface_.num_vertices(); ++v) {
    surface_.set_size(v, sizes_(surface_.xyz(v)));
  }
}

std::vector<Edge> SurfaceEditor::changed_edges(int pass) const
{
  return surface_.edges([&](LocalIndex v) { return has_changed(v, pass); });
}

bool SurfaceEditor::is_guarded(LocalIndex v) const
{
  if (!guard_) return false;
  Box around;
  for (const LocalIndex t : surface_.triangles_of(v)) around.include(box_of(surface_.corners(t)));
  return guard_->is_at(around);
}

double SurfaceEditor::relative_length(const Edge& edge) const
{
  // NETGEN's size is more of a middle: on a brick, its edges have a median of 1.18 times it.
  constexpr double kLengthOfSize = 1.18;
  const double size = 0.5 * (surface_.size(edge[0]) + surface_.size(edge[1]));
  return norm(surface_.xyz(edge[1]) - surface_.xyz(edge[0])) / (kLengthOfSize * size);
}

double SurfaceEditor::shape(LocalIndex t)
{
  double& known = shapes_[at(t)];
  if (known == kUnknown) {
    const PlacedTriangle one = placed(surface_.triangle(t), surface_.patch(t));
    known = is_upright(one) ? angle_shape(one.corners) : kTurnedOver;
  }
  return known;
}

double SurfaceEditor::worst_shape(std::span<const LocalIndex> triangles)
{
  double worst = 1.0;
  for (const LocalIndex t : triangles) worst = std::min(worst, shape(t));
  return worst;
}

// The reference is asked at the corners, whose answers are kept; only if these do not settle it, in
// the middle, if that is near: inside of a thin tube all directions are those of some wall.
bool SurfaceEditor::is_upright(const PlacedTriangle& one)
{
  const Vec3 n = normal_of(one.corners);
  const double least = kLeastCosine * norm(n);
  bool all_corners = true;
  for (std::size_t c = 0; c < 3 && all_corners; ++c) {
    all_corners = dot(n, normal_at(one.vertices[c], one.patch, one.corners[c])) >= least;
  }
  if (all_corners || reference_.normal_of_plane(one.patch) != nullptr) return all_corners;
  const Vec3 middle = middle_of(one.corners);
  const auto [near, normal] = reference_.place_on_patch(one.patch, middle);
  const double least_size = norm(near - middle) / kMostOffMiddle;
  const auto is_near = [&](LocalIndex v) { return surface_.size(v) >= least_size; };
  return dot(n, normal) >= least && std::ranges::all_of(one.vertices, is_near);
}

SurfaceEditor::KnownNormal& SurfaceEditor::known_normal(LocalIndex v, LocalIndex patch)
{
  normals_.resize(std::max(normals_.size(), at(v) + 1));
  std::vector<KnownNormal>& known = normals_[at(v)];
  const auto found = std::ranges::find(known, patch, &KnownNormal::patch);
  return found != known.end() ? *found : known.emplace_back(KnownNormal{patch});
}

const Vec3& SurfaceEditor::normal_at(LocalIndex v, LocalIndex patch, const Vec3& place)
{
  if (const Vec3* const all = reference_.normal_of_plane(patch)) return *all;
  KnownNormal& known = known_normal(v, patch);
  if (known.came_at(place)) return known.came.normal;
  known.came_last = false;
  if (known.asked.place != place) known.asked = {place, reference_.normal(patch, place)};
  return known.asked.normal;
}

Vec3 SurfaceEditor::along(LocalIndex v, const Vec3& vector)
{
  if (surface_.freedom(v) == Freedom::curve) {
    const std::vector<LocalIndex> two = surface_.curve_neighbours(v);
    const Vec3 tangent = unit(surface_.xyz(two.back()) - surface_.xyz(two.front()));
    return dot(vector, tangent) * tangent;
  }
  const LocalIndex patch = surface_.patch(surface_.triangles_of(v).front());
  const Vec3& normal = normal_at(v, patch, surface_.xyz(v));
  return vector - dot(vector, normal) * normal;
}

void SurfaceEditor::note_change(std::span<const LocalIndex> triangles)
{
  changed_.resize(at(surface_.num_vertices()), pass_);
  shapes_.resize(at(surface_.num_triangles()), kUnknown);
  for (const LocalIndex t : triangles) {
    shapes_[at(t)] = kUnknown;
    for (const LocalIndex v : surface_.triangle(t)) changed_[at(v)] = pass_;
  }
  touch(triangles);
}

// Steps at their vertices may come to something else now.
void SurfaceEditor::touch(std::span<const LocalIndex> triangles)
{
  ++num_changes_;
  touched_.resize(at(surface_.num_vertices()), num_changes_);
  for (const LocalIndex t : triangles) {
    for (const LocalIndex v : surface_.triangle(t)) touched_[at(v)] = num_changes_;
  }
}

// Triangle `t` has become one that is upright.
void SurfaceEditor::put(LocalIndex t, const PlacedTriangle& one)
{
  if (guard_) guard_->change(t, one);
  shapes_[at(t)] = angle_shape(one.corners);
}

// Looks at the reference only if all shapes are good enough.
bool SurfaceEditor::all_better(std::span<const PlacedTriangle> candidates, double least)
{
  for (const PlacedTriangle& one : candidates) {
    if (angle_shape(one.corners) <= least) return false;
  }
  return std::ranges::all_of(candidates,
                             [this](const PlacedTriangle& one) { return is_upright(one); });
}

// A step inside a flat patch covers what was covered before, so it cuts nothing that was not cut.
bool SurfaceEditor::cuts_nothing(std::span<const LocalIndex> old,
                                 std::span<const PlacedTriangle> made, bool is_inside)
{
  if (!guard_) return true;
  const bool is_in_plane =
      is_inside && reference_.normal_of_plane(surface_.patch(old.front())) != nullptr
      && std::ranges::all_of(old, [this](LocalIndex t) { return shape(t) >= 0.0; });
  return is_in_plane || guard_->allows(old, made);
}

double SurfaceEditor::fair_shape(LocalIndex v)
{
  return std::clamp(worst_shape(surface_.triangles_of(v)), 0.0, kFairShape);
}

bool SurfaceEditor::flip_if_better(const Edge& edge)
{
  const auto found = surface_.flipped(edge);
  return found && flip(*found, std::max(worst_shape(found->triangles), 0.0) + kGain);
}

bool SurfaceEditor::flip(const Edge& edge, double least)
{
  const auto found = surface_.flipped(edge);
  return found && flip(*found, least);
}

bool SurfaceEditor::flip(const EditableSurface::Flip& flip, double least)
{
  const LocalIndex patch = surface_.patch(flip.triangles[0]);
  const std::array made{placed(flip.made[0], patch), placed(flip.made[1], patch)};
  if (!all_better(made, least) || !cuts_nothing(flip.triangles, made, true)) return false;
  surface_.flip(flip);
  note_change(flip.triangles);
  for (std::size_t side = 0; side < 2; ++side) put(flip.triangles[side], made[side]);
  return true;
}

Vec3 SurfaceEditor::on_reference(const Edge& edge, const Vec3& point) const
{
  const LocalIndex curve = surface_.curve(edge[0], edge[1]);
  if (curve != kNoIndex) return on_curve(curve, point, surface_.size(edge[0]));
  return reference_.on_patch(surface_.patch(surface_.triangles_at(edge).front()), point);
}

// A projection may find another branch of the curve, but not near the reference.
Vec3 SurfaceEditor::on_curve(LocalIndex curve, const Vec3& point, double size) const
{
  const Vec3 near = reference_.on_curve(curve, point);
  if (model_ == nullptr) return near;
  const auto place = projections_.run<GeometryError>(
      [&] { return on_model_curve(reference_, *model_, curve, near); });
  // Without one as if there were no model; put_on_geometry() tries once more.
  return place && norm(*place - near) < kMostOffReference * size ? *place : near;
}

// What a vertex in an edge makes of the triangles there.
std::vector<PlacedTriangle> SurfaceEditor::halves(std::span<const LocalIndex> triangles,
                                                  const Edge& edge, const Vec3& middle) const
{
  std::vector<PlacedTriangle> made;
  made.reserve(2 * triangles.size());
  for (const LocalIndex t : triangles) {
    for (const LocalIndex end : edge) {
      PlacedTriangle half{surface_.triangle(t), surface_.corners(t)};
      const auto corner =
          static_cast<std::size_t>(std::ranges::find(half.vertices, end) - half.vertices.begin());
      half.vertices[corner] = surface_.num_vertices();
      half.corners[corner] = middle;
      made.push_back(half);
    }
  }
  return made;
}

LocalIndex SurfaceEditor::split(const Edge& edge, double part)
{
  const std::vector<LocalIndex> old = surface_.triangles_at(edge);
  const Vec3& a = surface_.xyz(edge[0]);
  const Vec3& b = surface_.xyz(edge[1]);
  const Vec3 chord = a + part * (b - a);
  const Vec3 wanted = on_reference(edge, chord);
  const bool is_inside = surface_.curve(edge[0], edge[1]) == kNoIndex;
  const double most = (1.0 - kLeastProgress * std::min(part, 1.0 - part)) * norm(b - a);
  const bool is_between = norm(wanted - a) <= most && norm(wanted - b) <= most;
  const bool is_free =
      is_between && (!guard_ || cuts_nothing(old, halves(old, edge, wanted), is_inside));
  const LocalIndex middle = surface_.split(edge, is_free ? wanted : chord);
  surface_.set_size(middle, sizes_(surface_.xyz(middle)));
  const std::span<const LocalIndex> made = surface_.triangles_of(middle);
  note_change(made);
  if (guard_) guard_changed(made, old.front());
  return middle;
}

// Triangles that were made without asking; new ones lie beside another.
void SurfaceEditor::guard_changed(std::span<const LocalIndex> made, LocalIndex beside)
{
  for (const LocalIndex t : made) {
    const bool is_upright = shape(t) >= 0.0;
    const PlacedTriangle one =
        placed(surface_.triangle(t), is_upright ? surface_.patch(t) : kNoIndex);
    if (t < guard_->num_triangles()) {
      guard_->change(t, one);
    } else {
      guard_->add(one, beside);
    }
  }
}

bool SurfaceEditor::keeps_lengths(LocalIndex gone, LocalIndex kept) const
{
  for (const LocalIndex t : surface_.triangles_of(gone)) {
    for (const LocalIndex other : surface_.triangle(t)) {
      if (other == kept || other == gone) continue;
      const double before = std::max(relative_length({other, gone}), kMuchTooLong / kHardlyLonger);
      if (relative_length({other, kept}) > kHardlyLonger * before) return false;
    }
  }
  return true;
}

double SurfaceEditor::off_curve(LocalIndex curve, const Vec3& point) const
{
  return norm(reference_.on_curve(curve, point) - point);
}

// How far the middle of an edge is off its curve, beyond what its ends are, in parts of its length.
double SurfaceEditor::bow(LocalIndex curve, const Vec3& a, const Vec3& b) const
{
  const double of_ends = std::max(off_curve(curve, a), off_curve(curve, b));
  return (off_curve(curve, midpoint(a, b)) - of_ends) / norm(b - a);
}

bool SurfaceEditor::keeps_curve(LocalIndex gone, LocalIndex kept) const
{
  const LocalIndex curve = surface_.curve(gone, kept);
  if (curve == kNoIndex) return true;
  return std::ranges::all_of(surface_.curve_neighbours(gone), [&](LocalIndex other) {
    return other == kept || bow(curve, surface_.xyz(other), surface_.xyz(kept)) <= kMostBow;
  });
}

// Of a move: edges that leave their curve farther than that already may do so, but not still
// farther.
bool SurfaceEditor::keeps_curve(LocalIndex v, const Vec3& before, const Vec3& after) const
{
  double most_before = kMostBowOfMove;
  double most_after = 0.0;
  for (const LocalIndex other : surface_.curve_neighbours(v)) {
    const LocalIndex curve = surface_.curve(v, other);
    most_before = std::max(most_before, bow(curve, surface_.xyz(other), before));
    most_after = std::max(most_after, bow(curve, surface_.xyz(other), after));
  }
  return most_after <= most_before;
}

bool SurfaceEditor::collapse(LocalIndex gone, LocalIndex kept, double least)
{
  if (!keeps_lengths(gone, kept) || !surface_.can_collapse(gone, kept)
      || !keeps_curve(gone, kept)) {
    return false;
  }
  const std::vector<LocalIndex> old = surface_.copied_triangles_of(gone);
  std::vector<LocalIndex> left;
  Candidates made;
  for (const LocalIndex t : old) {
    if (holds(surface_.triangle(t), kept)) continue;
    const Triangle v = replaced(surface_.triangle(t), gone, kept);
    made.push_back(placed(v, surface_.patch(t)));
    left.push_back(t);
  }
  if (!all_better(made, least)) return false;
  const bool is_inside = surface_.freedom(gone) == Freedom::patch;
  if (!cuts_nothing(old, made, is_inside)) return false;
  surface_.collapse(gone, kept);
  for (const LocalIndex t : old) {
    if (guard_ && !surface_.is_triangle(t)) guard_->remove(t);
  }
  note_change(surface_.triangles_of(kept));
  for (std::size_t i = 0; i < left.size(); ++i) put(left[i], made[i]);
  return true;
}

PlacedTriangle SurfaceEditor::placed(const Triangle& v, LocalIndex patch) const
{
  return {v, {surface_.xyz(v[0]), surface_.xyz(v[1]), surface_.xyz(v[2])}, patch};
}

SurfaceEditor::Candidates SurfaceEditor::ring_of(LocalIndex v) const
{
  Candidates ring;
  ring.reserve(surface_.triangles_of(v).size());
  for (const LocalIndex t : surface_.triangles_of(v)) {
    ring.push_back(placed(surface_.triangle(t), surface_.patch(t)));
  }
  return ring;
}

// In a plane no step turns a triangle over, so a vertex stays within its patch by itself.
Vec3 SurfaceEditor::place_for(LocalIndex v, const Vec3& wanted)
{
  if (surface_.freedom(v) == Freedom::curve) {
    const LocalIndex curve = surface_.curve(v, surface_.curve_neighbours(v).front());
    return on_curve(curve, wanted, surface_.size(v));
  }
  const LocalIndex patch = surface_.patch(surface_.triangles_of(v).front());
  if (reference_.normal_of_plane(patch) != nullptr) return wanted;
  const auto [place, normal] = reference_.place_on_patch(patch, wanted);
  KnownNormal& known = known_normal(v, patch);
  const Vec3& now = surface_.xyz(v);
  // Even if the vertex stays where it is, another normal may count there from now on.
  if (known.came_at(now) || place == now) touch(surface_.triangles_of(v));
  known.came = {place, normal};
  known.came_last = true;
  return place;
}

bool SurfaceEditor::move(LocalIndex v, const Vec3& wanted, double least)
{
  // Shapes of now must be known before the vertex is elsewhere.
  static_cast<void>(worst_shape(surface_.triangles_of(v)));
  const Vec3 before = surface_.xyz(v);
  const Vec3 place = place_for(v, wanted);
  if (surface_.freedom(v) == Freedom::curve && !keeps_curve(v, before, place)) return false;
  surface_.move(v, place);
  const Candidates made = ring_of(v);
  const std::span<const LocalIndex> around = surface_.triangles_of(v);
  const bool is_inside = surface_.freedom(v) == Freedom::patch;
  if (!all_better(made, least) || !cuts_nothing(around, made, is_inside)) {
    surface_.move(v, before);
    return false;
  }
  note_change(around);
  for (std::size_t i = 0; i < around.size(); ++i) put(around[i], made[i]);
  return true;
}

void SurfaceEditor::put_at(LocalIndex v, const Vec3& place)
{
  surface_.move(v, place);
  const std::span<const LocalIndex> around = surface_.triangles_of(v);
  note_change(around);
  if (guard_) guard_changed(around, around.front());
}

}  // namespace tessera::surface
