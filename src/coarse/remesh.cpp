// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/coarse/remesh.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "tessera/base/repair.hpp"

#include "coarse/crossings.hpp"
#include "coarse/editable_surface.hpp"
#include "coarse/surface_sizes.hpp"
#include "coarse/wall_sizes.hpp"

namespace tessera::coarse {
namespace {

using Edge = PatchSurface::Edge;
using Triangle = PatchSurface::Triangle;

// In parts of the wanted length: longer edges are split, shorter ones collapsed. The original
// method has 4/3 and 4/5. Wider apart, a size field is followed with fewer steps back and forth.
constexpr double kTooLong = 1.4;
constexpr double kTooShort = 0.7;

constexpr int kRounds = 5;
constexpr int kMostSweeps = 30;  // Of one kind within a round; each halves the longest edges.
constexpr int kFlipSweeps = 4;
constexpr int kFewSteps = 200;  // A sweep that took fewer than one step in so many vertices ends.

// Shapes from 0, flat, to 1, equilateral. A step may leave no triangle worse than this, unless one
// was worse before.
constexpr double kFairShape = 0.3;

// Among triangles better than this, smoothing need not make the worst better.
constexpr double kGoodShape = 0.6;

// In parts of the wanted length: a vertex so near to its best place stays.
constexpr double kSettled = 0.04;

constexpr double kTurnedOver = -1.0;
constexpr double kUnknown = -2.0;

// A triangle whose normal is more than 60 degrees off the reference's is turned over or cuts a
// corner.
constexpr double kLeastCosine = 0.5;

// A new edge of a curve may leave the curve by this part of its length.
constexpr double kMostSagitta = 0.2;

using Corners = std::array<Vec3, 3>;

// The triangles that a step would make, and their patches.
struct Candidates {
  std::vector<PlacedTriangle> triangles{};
  std::vector<LocalIndex> patches{};
};

// 4 sqrt(3) area over the sum of the squared edges: 1 for an equilateral triangle, 0 for a flat
// one.
double quality(const Corners& p)
{
  const std::array<Vec3, 3> sides{p[1] - p[0], p[2] - p[1], p[0] - p[2]};
  const double squares =
      dot(sides[0], sides[0]) + dot(sides[1], sides[1]) + dot(sides[2], sides[2]);
  return squares > 0.0 ? 2.0 * std::sqrt(3.0) * norm(cross(sides[0], sides[1])) / squares : 0.0;
}

class Remesher {
 public:
  Remesher(const SurfaceReference& reference, const PatchSurface& start, std::vector<double> sizes)
      : reference_(reference), surface_(start, std::move(sizes)), guard_(start)
  {
  }

  // Triangles of the reference may be as large as its faces: only when they are cut there are
  // vertices where a wall is thin.
  void see_walls(const CoarseOptions& options)
  {
    if (is_left_out(Repair::wall_sizes)) return;
    sweep([this] { return flip_edges(); }, kFlipSweeps);
    sweep([this] { return split_long_edges(); }, kMostSweeps);
    surface_.set_sizes(wall_sizes(surface_, reference_.surface().patch_materials, options));
  }

  PatchSurface run()
  {
    for (int round = 0; round < kRounds; ++round) {
      sweep([this] { return flip_edges(); }, kFlipSweeps);
      sweep([this] { return collapse_short_edges(); }, kMostSweeps);
      sweep([this] { return flip_edges(); }, kFlipSweeps);
      sweep([this] { return split_long_edges(); }, kMostSweeps);
      sweep([this] { return flip_edges(); }, kFlipSweeps);
      for (LocalIndex v = 0; v < surface_.num_vertices(); ++v) smooth(v);
    }
    sweep([this] { return flip_edges(); }, kFlipSweeps);
    for (LocalIndex v = 0; v < surface_.num_vertices(); ++v) smooth(v);
    return surface_.take(reference_.surface());
  }

 private:
  // Until hardly anything is left to do: the next round does the rest.
  template <class Pass>
  void sweep(const Pass& pass, int most) const
  {
    for (int i = 0; i < most; ++i) {
      if (kFewSteps * pass() <= surface_.num_vertices()) return;
    }
  }

  [[nodiscard]] double length(const Edge& edge) const
  {
    return norm(surface_.xyz(edge[1]) - surface_.xyz(edge[0]));
  }

  // Length over the wanted one.
  [[nodiscard]] double relative_length(const Edge& edge) const
  {
    return length(edge) / (0.5 * (surface_.size(edge[0]) + surface_.size(edge[1])));
  }

  [[nodiscard]] Corners corners(const Triangle& v) const
  {
    return {surface_.xyz(v[0]), surface_.xyz(v[1]), surface_.xyz(v[2])};
  }

  void add_candidate(const Triangle& v, LocalIndex patch, Candidates& to) const
  {
    to.triangles.push_back({v, corners(v)});
    to.patches.push_back(patch);
  }

  [[nodiscard]] bool is_upright(const Corners& p, LocalIndex patch) const
  {
    const Vec3 n = cross(p[1] - p[0], p[2] - p[0]);
    const Vec3 middle = (1.0 / 3.0) * (p[0] + p[1] + p[2]);
    return dot(n, reference_.normal(patch, middle)) >= kLeastCosine * norm(n);
  }

  // quality() of a triangle; kTurnedOver if it does not look the reference's way. Kept until the
  // triangle changes: most are asked for often and change seldom.
  [[nodiscard]] double shape(LocalIndex t)
  {
    if (at(t) >= shapes_.size()) shapes_.resize(at(t) + 1, kUnknown);
    double& known = shapes_[at(t)];
    if (known == kUnknown) {
      const Corners p = surface_.corners(t);
      known = is_upright(p, surface_.patch(t)) ? quality(p) : kTurnedOver;
    }
    return known;
  }

  // Triangles that changed.
  void forget(const std::vector<LocalIndex>& triangles)
  {
    for (const LocalIndex t : triangles) {
      if (at(t) < shapes_.size()) shapes_[at(t)] = kUnknown;
      if (at(t) >= changed_.size()) changed_.resize(at(t) + 1, flip_sweep_);
      changed_[at(t)] = flip_sweep_;
    }
  }

  // Since the sweep before this one began; else flipping their edge was refused then already.
  [[nodiscard]] bool has_changed(LocalIndex t) const
  {
    return at(t) >= changed_.size() || changed_[at(t)] + 1 >= flip_sweep_;
  }

  [[nodiscard]] double worst_shape(const std::vector<LocalIndex>& triangles)
  {
    double worst = 1.0;
    for (const LocalIndex t : triangles) worst = std::min(worst, shape(t));
    return worst;
  }

  // Whether all have a better shape than `least`; looks at the reference only if that can be.
  [[nodiscard]] bool all_better(const Candidates& candidates, double least) const
  {
    for (const PlacedTriangle& one : candidates.triangles) {
      if (quality(one.corners) <= least) return false;
    }
    for (std::size_t i = 0; i < candidates.triangles.size(); ++i) {
      if (!is_upright(candidates.triangles[i].corners, candidates.patches[i])) return false;
    }
    return true;
  }

  int flip_edges()
  {
    constexpr double kGain = 1e-3;  // Against flips back and forth.
    int count = 0;
    ++flip_sweep_;
    for (const Edge& edge : surface_.edges()) {
      const std::vector<LocalIndex> two = surface_.triangles_at(edge);
      if (std::ranges::none_of(two, [this](LocalIndex t) { return has_changed(t); })) continue;
      const auto triangles = surface_.flipped(edge);
      if (!triangles) continue;
      const LocalIndex patch = surface_.patch(two[0]);
      const double before = std::max(worst_shape(two), 0.0);
      Candidates made;
      for (const Triangle& v : *triangles) add_candidate(v, patch, made);
      if (!all_better(made, before + kGain) || !guard_.allows(two, made.triangles)) continue;
      surface_.flip(edge, *triangles);
      for (std::size_t side = 0; side < 2; ++side) guard_.change(two[side], made.triangles[side]);
      forget(two);
      ++count;
    }
    return count;
  }

  int split_long_edges()
  {
    std::vector<std::pair<double, Edge>> longest;
    for (const Edge& edge : surface_.edges()) {
      const double relative = relative_length(edge);
      if (relative > kTooLong) longest.emplace_back(-relative, edge);
    }
    std::ranges::sort(longest);
    for (const auto& [relative, edge] : longest) split(edge);
    return static_cast<int>(longest.size());
  }

  // Where the middle of the edge on the reference would lie beyond another sheet, it stays on the
  // chord, where it changes nothing.
  void split(const Edge& edge)
  {
    const std::vector<LocalIndex> old = surface_.triangles_at(edge);
    const Vec3 chord = midpoint(surface_.xyz(edge[0]), surface_.xyz(edge[1]));
    const Vec3 wanted = on_reference(edge, chord);
    const bool is_free = guard_.allows(old, halves(old, edge, wanted));
    const LocalIndex middle = surface_.split(edge, is_free ? wanted : chord);
    const std::vector<LocalIndex>& made = surface_.triangles_of(middle);
    for (const LocalIndex t : made) {
      const PlacedTriangle placed{surface_.triangle(t), surface_.corners(t)};
      if (t < guard_.num_triangles()) {
        guard_.change(t, placed);
      } else {
        guard_.add(placed, old.front());
      }
    }
    forget(made);
  }

  // What a vertex in an edge makes of the triangles there.
  [[nodiscard]] std::vector<PlacedTriangle> halves(const std::vector<LocalIndex>& triangles,
                                                   const Edge& edge, const Vec3& middle) const
  {
    std::vector<PlacedTriangle> made;
    for (const LocalIndex t : triangles) {
      for (const LocalIndex end : edge) {
        const Triangle& v = surface_.triangle(t);
        PlacedTriangle half{v, corners(v)};
        const auto corner = static_cast<std::size_t>(std::ranges::find(v, end) - v.begin());
        half.vertices[corner] = surface_.num_vertices();
        half.corners[corner] = middle;
        made.push_back(half);
      }
    }
    return made;
  }

  [[nodiscard]] Vec3 on_reference(const Edge& edge, const Vec3& point) const
  {
    const LocalIndex curve = surface_.curve(edge[0], edge[1]);
    if (curve != kNoIndex) return reference_.on_curve(curve, point);
    return reference_.on_patch(surface_.patch(surface_.triangles_at(edge).front()), point);
  }

  int collapse_short_edges()
  {
    std::vector<std::pair<double, Edge>> shortest;
    for (const Edge& edge : surface_.edges()) {
      const double relative = relative_length(edge);
      if (relative < kTooShort) shortest.emplace_back(relative, edge);
    }
    std::ranges::sort(shortest);
    int count = 0;
    for (const auto& [relative, edge] : shortest) {
      const auto [a, b] = edge;
      if (!surface_.is_vertex(a) || !surface_.is_vertex(b) || !surface_.has_edge(a, b)) continue;
      count += collapse(a, b) || collapse(b, a) ? 1 : 0;
    }
    return count;
  }

  bool collapse(LocalIndex gone, LocalIndex kept)
  {
    if (!surface_.can_collapse(gone, kept) || !keeps_curve(gone, kept)) return false;
    for (const LocalIndex other : surface_.neighbours(gone)) {
      if (other != kept && relative_length({other, kept}) > kTooLong) return false;
    }
    const std::vector<LocalIndex> old = surface_.triangles_of(gone);
    std::vector<LocalIndex> left;
    Candidates made;
    for (const LocalIndex t : old) {
      Triangle v = surface_.triangle(t);
      if (std::ranges::find(v, kept) != v.end()) continue;
      std::ranges::replace(v, gone, kept);
      add_candidate(v, surface_.patch(t), made);
      left.push_back(t);
    }
    if (!all_better(made, std::clamp(worst_shape(old), 0.0, kFairShape))) return false;
    if (!guard_.allows(old, made.triangles)) return false;
    surface_.collapse(gone, kept);
    for (const LocalIndex t : old) {
      if (std::ranges::find(left, t) == left.end()) guard_.remove(t);
    }
    for (std::size_t i = 0; i < left.size(); ++i) guard_.change(left[i], made.triangles[i]);
    forget(surface_.triangles_of(kept));
    return true;
  }

  [[nodiscard]] bool keeps_curve(LocalIndex gone, LocalIndex kept) const
  {
    const LocalIndex curve = surface_.curve(gone, kept);
    if (curve == kNoIndex) return true;
    for (const LocalIndex other : surface_.curve_neighbours(gone)) {
      if (other == kept) continue;
      const Vec3 middle = midpoint(surface_.xyz(other), surface_.xyz(kept));
      const double off = norm(reference_.on_curve(curve, middle) - middle);
      if (off > kMostSagitta * length({other, kept})) return false;
    }
    return true;
  }

  void smooth(LocalIndex v)
  {
    if (!surface_.is_vertex(v) || surface_.freedom(v) == Freedom::none) return;
    const bool is_on_curve = surface_.freedom(v) == Freedom::curve;
    const std::vector<LocalIndex> around =
        is_on_curve ? surface_.curve_neighbours(v) : surface_.neighbours(v);
    Vec3 sum{};
    for (const LocalIndex other : around) sum = sum + surface_.xyz(other);
    const Vec3 middle = (1.0 / static_cast<double>(around.size())) * sum;
    if (norm(middle - surface_.xyz(v)) < kSettled * surface_.size(v)) return;
    const LocalIndex curve = is_on_curve ? surface_.curve(v, around.front()) : kNoIndex;
    const std::vector<LocalIndex>& around_v = surface_.triangles_of(v);
    const LocalIndex patch = surface_.patch(around_v.front());
    const Vec3 before = surface_.xyz(v);
    const double worst = worst_shape(around_v);
    for (const double step : {1.0, 0.5, 0.25}) {
      const Vec3 wanted = before + step * (middle - before);
      surface_.move(
          v, is_on_curve ? reference_.on_curve(curve, wanted) : reference_.on_patch(patch, wanted));
      Candidates made;
      for (const LocalIndex t : around_v) {
        add_candidate(surface_.triangle(t), surface_.patch(t), made);
      }
      if (!all_better(made, std::clamp(worst, 0.0, kGoodShape))) continue;
      if (!guard_.allows(around_v, made.triangles)) continue;
      for (std::size_t i = 0; i < around_v.size(); ++i) {
        guard_.change(around_v[i], made.triangles[i]);
      }
      forget(around_v);
      return;
    }
    surface_.move(v, before);
  }

  const SurfaceReference& reference_;
  EditableSurface surface_;
  CrossingGuard guard_;
  int flip_sweep_ = 0;
  std::vector<int> changed_{};    // The flip sweep in which or after which each triangle did.
  std::vector<double> shapes_{};  // Of the triangles.
};

}  // namespace

PatchSurface remesh(const SurfaceReference& reference, const CoarseOptions& options)
{
  return remesh(reference, reference.surface(), options);
}

PatchSurface remesh(const SurfaceReference& reference, const PatchSurface& start,
                    const CoarseOptions& options)
{
  Remesher remesher(reference, start, surface_sizes(start, options));
  remesher.see_walls(options);
  return remesher.run();
}

PatchSurface remesh_finer(const SurfaceReference& reference, const PatchSurface& surface,
                          const std::vector<std::size_t>& triangles, const CoarseOptions& options)
{
  return Remesher(reference, surface, finer_sizes(surface, triangles, options.grading)).run();
}

}  // namespace tessera::coarse
