// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/surface/mend_surface.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

#include "tessera/base/triangle.hpp"
#include "tessera/surface/overlap.hpp"

#include "surface/editable_surface.hpp"
#include "surface/groups.hpp"

namespace tessera::surface {
namespace {

using Edge = EditableSurface::Edge;
using Triangle = EditableSurface::Triangle;
using Corners = std::array<Vec3, 3>;

constexpr double kBad_deg = 20.0;
constexpr int kRounds = 4;

// What a step must gain, against steps back and forth, and what another bad triangle may lose.
constexpr double kLeastGain = 1.1;
constexpr double kMostLoss = 0.95;

// The same of a vertex less on a curve. With less, narrow strips get long bad triangles for short.
constexpr double kLeastGainOfThinning = 1.5;

// New triangles turn by less than this from what was there, unless that differs by more itself.
constexpr double kLeastCosine = 0.9;

// A new triangle may leave the geometry by this part of its longest edge, or as far as was.
constexpr double kMostSagitta = 0.05;

struct Candidate {
  Corners corners{};
  LocalIndex group = kNoIndex;
  LocalIndex from = kNoIndex;  // The triangle that it is when a corner has moved.
};

double angle_deg(const Vec3& at, const Vec3& a, const Vec3& b)
{
  return angle_between(a - at, b - at) * 180.0 / std::numbers::pi;
}

double smallest_angle(const Corners& p)
{
  return std::min(
      {angle_deg(p[0], p[1], p[2]), angle_deg(p[1], p[2], p[0]), angle_deg(p[2], p[0], p[1])});
}

class Mender {
 public:
  /// @param[in] thins_curves  Also take vertices out of curves, away from the shortest edges.
  Mender(SurfaceGroups& groups, bool thins_curves)
      : groups_(groups), surface_(groups.surface(), sizes_of(groups)), thins_curves_(thins_curves)
  {
  }

  MendStatistics run()
  {
    for (int round = 0; round < kRounds; ++round) {
      const LocalIndex before = done_.total();
      for (const LocalIndex t : worst_first()) {
        if (is_bad(t)) mend(t);
      }
      if (done_.total() == before) break;
    }
    return done_;
  }

  [[nodiscard]] const EditableSurface& surface() const { return surface_; }

 private:
  static std::vector<double> sizes_of(const SurfaceGroups& groups)
  {
    return std::vector<double>(groups.surface().vertex_xyz.size(), 0.0);  // None is wanted.
  }

  [[nodiscard]] Corners corners(const Triangle& v) const
  {
    return {surface_.xyz(v[0]), surface_.xyz(v[1]), surface_.xyz(v[2])};
  }

  [[nodiscard]] bool is_bad(LocalIndex t) const
  {
    const Triangle& v = surface_.triangle(t);
    return v[0] != kNoIndex && angle_of(t) < kBad_deg;
  }

  [[nodiscard]] std::vector<LocalIndex> worst_first() const
  {
    std::vector<std::pair<double, LocalIndex>> bad;
    for (LocalIndex t = 0; t < surface_.num_triangles(); ++t) {
      if (is_bad(t)) bad.emplace_back(angle_of(t), t);
    }
    std::ranges::sort(bad);
    std::vector<LocalIndex> triangles;
    for (const auto& [angle, t] : bad) triangles.push_back(t);
    return triangles;
  }

  void mend(LocalIndex t)
  {
    const std::array<Edge, 3> edges = by_length(t);
    for (const Edge& edge : edges) {  // A longer one first: it is opposite to the flattest corner.
      if (flip(edge, t)) return;
    }
    if (split(edges[0], t)) return;
    const auto [a, b] = edges[2];
    if (collapse(a, b, t) || collapse(b, a, t)) return;
    const Triangle v = surface_.triangle(t);
    if (std::ranges::any_of(v, [&](LocalIndex corner) { return thin_out_curve(corner, t); }))
      return;
    for (const LocalIndex corner : v) {
      if (is_bad(t)) smooth(corner, t);
    }
  }

  // Longest first.
  [[nodiscard]] std::array<Edge, 3> by_length(LocalIndex t) const
  {
    const Triangle& v = surface_.triangle(t);
    std::array<Edge, 3> edges;
    for (std::size_t c = 0; c < 3; ++c) {
      edges[c] = {std::min(v[c], v[(c + 1) % 3]), std::max(v[c], v[(c + 1) % 3])};
    }
    std::ranges::sort(edges, [this](const Edge& a, const Edge& b) {
      return std::pair(length(b), a) < std::pair(length(a), b);
    });
    return edges;
  }

  [[nodiscard]] double length(const Edge& edge) const
  {
    return norm(surface_.xyz(edge[1]) - surface_.xyz(edge[0]));
  }

  [[nodiscard]] double angle_of(LocalIndex t) const
  {
    return smallest_angle(corners(surface_.triangle(t)));
  }

  // Whether the candidates may take the place of the triangles, among them the bad one. `near`: a
  // vertex of them. Beside a triangle that the model wants to be bad another one can be mended.
  [[nodiscard]] bool is_better(std::span<const LocalIndex> old, LocalIndex bad,
                               const std::vector<Candidate>& candidates, LocalIndex near,
                               double gain = kLeastGain) const
  {
    const double wanted = gain * angle_of(bad);
    for (const Candidate& one : candidates) {
      const double angle = smallest_angle(one.corners);
      const bool may_be_bad = one.from != kNoIndex && one.from != bad;
      if (angle < wanted && !(may_be_bad && angle >= kMostLoss * angle_of(one.from))) return false;
    }
    return std::ranges::all_of(candidates, [&](const Candidate& one) {
      return looks_the_same_way(old, one) && is_near(old, one, near);
    });
  }

  [[nodiscard]] bool looks_the_same_way(std::span<const LocalIndex> old,
                                        const Candidate& candidate) const
  {
    Vec3 sum{};
    for (const LocalIndex t : old) {
      if (surface_.patch(t) == candidate.group)
        sum = sum + normal_of(corners(surface_.triangle(t)));
    }
    double least = kLeastCosine;
    for (const LocalIndex t : old) {
      if (surface_.patch(t) != candidate.group) continue;
      const Corners p = corners(surface_.triangle(t));
      if (angle_of(t) >= kBad_deg) least = std::min(least, cosine(normal_of(p), sum));
    }
    return cosine(normal_of(candidate.corners), sum) >= std::max(least, 0.0);
  }

  static double cosine(const Vec3& a, const Vec3& b)
  {
    const double lengths = norm(a) * norm(b);
    return lengths > 0.0 ? dot(a, b) / lengths : -1.0;
  }

  [[nodiscard]] bool is_near(std::span<const LocalIndex> old, const Candidate& candidate,
                             LocalIndex near) const
  {
    double most = kMostSagitta * longest_side(candidate.corners);
    const double off = distance(candidate, near);
    if (off <= most) return true;
    for (const LocalIndex t : old) {
      if (surface_.patch(t) != candidate.group) continue;
      most = std::max(most, distance({corners(surface_.triangle(t)), candidate.group}, near));
    }
    return off <= most;
  }

  [[nodiscard]] double distance(const Candidate& one, LocalIndex near) const
  {
    const Vec3 middle = middle_of(one.corners);
    return norm(groups_.on_group(one.group, near, middle) - middle);
  }

  bool flip(const Edge& edge, LocalIndex bad)
  {
    const auto flip = surface_.flipped(edge);
    if (!flip) return false;
    const auto& [two, made] = *flip;
    const LocalIndex group = surface_.patch(two[0]);
    if (!is_better(two, bad, {{corners(made[0]), group}, {corners(made[1]), group}}, edge[0])) {
      return false;
    }
    surface_.flip(*flip);
    ++done_.num_flips;
    return true;
  }

  bool collapse(LocalIndex gone, LocalIndex kept, LocalIndex bad, double gain = kLeastGain)
  {
    if (!surface_.can_collapse(gone, kept) || !keeps_curve(gone, kept)) return false;
    std::vector<Candidate> candidates;
    for (const LocalIndex t : surface_.triangles_of(gone)) {
      Triangle v = surface_.triangle(t);
      if (std::ranges::find(v, kept) != v.end()) continue;
      std::ranges::replace(v, gone, kept);
      candidates.push_back({corners(v), surface_.patch(t), t});
    }
    if (!is_better(surface_.triangles_of(gone), bad, candidates, gone, gain)) return false;
    surface_.collapse(gone, kept);
    ++done_.num_collapses;
    return true;
  }

  // Between curves that touch, short edges make flat triangles.
  bool thin_out_curve(LocalIndex v, LocalIndex bad)
  {
    if (!thins_curves_ || surface_.freedom(v) != Freedom::curve) return false;
    return std::ranges::any_of(surface_.curve_neighbours(v), [&](LocalIndex other) {
      return collapse(v, other, bad, kLeastGainOfThinning);
    });
  }

  // The curve's new edge must follow it, and stay on one branch of its parameters.
  [[nodiscard]] bool keeps_curve(LocalIndex gone, LocalIndex kept) const
  {
    const LocalIndex curve = surface_.curve(gone, kept);
    if (curve == kNoIndex) return true;
    if (groups_.is_seam(curve, gone)) return false;
    return std::ranges::all_of(surface_.curve_neighbours(gone), [&](LocalIndex other) {
      if (other == kept) return true;
      const Vec3 middle = midpoint(surface_.xyz(other), surface_.xyz(kept));
      return norm(groups_.on_curve(curve, gone, middle) - middle)
             <= kMostSagitta * length({other, kept});
    });
  }

  // The third vertex of a flat triangle goes into the edge opposite to it.
  bool split(const Edge& edge, LocalIndex t)
  {
    const Triangle v = surface_.triangle(t);
    const LocalIndex gone = *std::ranges::find_if(
        v, [&](LocalIndex corner) { return corner != edge[0] && corner != edge[1]; });
    const LocalIndex curve = surface_.curve(edge[0], edge[1]);
    if (curve == kNoIndex || surface_.freedom(gone) != Freedom::patch) return false;
    if (groups_.model_curve(curve) == kNoIndex) return false;
    const Vec3 point = groups_.on_curve(curve, edge[0], surface_.xyz(gone));
    std::vector<LocalIndex> old = surface_.copied_triangles_of(gone);
    std::vector<Candidate> candidates;
    for (const LocalIndex other : old) {
      if (other != t) add_moved(other, gone, point, candidates);
    }
    for (const LocalIndex other : surface_.triangles_at(edge)) {
      if (other == t) continue;
      if (is_tied(other, edge, gone)) return false;
      add_moved(other, edge[0], point, candidates);
      add_moved(other, edge[1], point, candidates);
      old.push_back(other);
    }
    if (!is_better(old, t, candidates, gone)) return false;
    const LocalIndex group = surface_.patch(t);
    const LocalIndex middle = surface_.split(edge, point);
    groups_.place_on_curve(curve, middle, edge[0], point);
    for (const LocalIndex around : surface_.triangles_of(middle)) {
      groups_.place_on_group(surface_.patch(around), middle,
                             surface_.patch(around) == group ? gone : edge[0], point);
    }
    surface_.collapse(gone, middle);
    ++done_.num_splits;
    return true;
  }

  void add_moved(LocalIndex t, LocalIndex v, const Vec3& point,
                 std::vector<Candidate>& candidates) const
  {
    Corners p = corners(surface_.triangle(t));
    for (std::size_t c = 0; c < 3; ++c) {
      if (surface_.triangle(t)[c] == v) p[c] = point;
    }
    candidates.push_back({p, surface_.patch(t), t});
  }

  // Whether a triangle's corner off the edge is a neighbour of the vertex: both cannot be joined.
  [[nodiscard]] bool is_tied(LocalIndex t, const Edge& edge, LocalIndex v) const
  {
    return std::ranges::any_of(surface_.triangle(t), [&](LocalIndex corner) {
      return corner != edge[0] && corner != edge[1] && surface_.has_edge(corner, v);
    });
  }

  void smooth(LocalIndex v, LocalIndex bad)
  {
    if (!surface_.is_vertex(v) || surface_.freedom(v) == Freedom::none) return;
    const bool is_on_curve = surface_.freedom(v) == Freedom::curve;
    const std::vector<LocalIndex> around =
        is_on_curve ? surface_.curve_neighbours(v) : surface_.neighbours(v);
    Vec3 sum{};
    for (const LocalIndex other : around) sum = sum + surface_.xyz(other);
    const Vec3 step = (1.0 / static_cast<double>(around.size())) * sum - surface_.xyz(v);
    const LocalIndex curve = is_on_curve ? surface_.curve(v, around.front()) : kNoIndex;
    const std::span<const LocalIndex> triangles = surface_.triangles_of(v);
    const LocalIndex group = surface_.patch(triangles.front());
    for (const double share : {1.0, 0.5, 0.25}) {
      const Vec3 wanted = surface_.xyz(v) + share * step;
      const Vec3 point =
          is_on_curve ? groups_.on_curve(curve, v, wanted) : groups_.on_group(group, v, wanted);
      std::vector<Candidate> candidates;
      for (const LocalIndex t : triangles) add_moved(t, v, point, candidates);
      if (!is_better(triangles, bad, candidates, v)) continue;
      surface_.move(v, point);
      if (is_on_curve) groups_.place_on_curve(curve, v, v, point);
      for (const LocalIndex t : triangles) groups_.place_on_group(surface_.patch(t), v, v, point);
      ++done_.num_moves;
      return;
    }
  }

  SurfaceGroups& groups_;
  EditableSurface surface_;
  bool thins_curves_;
  MendStatistics done_{};
};

}  // namespace

MendStatistics mend_surface(CoarseSurface& surface, const model::Model& model)
{
  for (const bool thins_curves : {true, false}) {
    SurfaceGroups groups(surface, model);
    Mender mender(groups, thins_curves);
    const MendStatistics done = mender.run();
    if (done.total() == 0) return done;
    if (!find_overlaps(mender.surface().take(groups.surface())).empty()) continue;
    surface = groups.take(mender.surface());
    return done;
  }
  return {};
}

}  // namespace tessera::surface
