// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/surface/mend_folds.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "tessera/base/arc.hpp"
#include "tessera/base/error.hpp"
#include "tessera/base/given_up.hpp"
#include "tessera/base/repair.hpp"
#include "tessera/mesh/tet_topology.hpp"
#include "tessera/surface/overlap.hpp"

#include "surface/editable_surface.hpp"
#include "surface/groups.hpp"

namespace tessera::surface {
namespace {

using Edge = EditableSurface::Edge;
using Triangle = EditableSurface::Triangle;
using Corners = std::array<Vec3, 3>;

// Each makes arcs a quarter as high. What is left after so many has another cause.
constexpr int kRounds = 8;

// Triangles that take the place of others turn by less than this. A triangle that folds may lie
// across a strong bend.
constexpr double kLeastCosine = 0.2;

// Of the quarter of its parent's area that a child should have. Less is a needle: an arc is nearly
// as high as the triangle beside it.
constexpr double kLeastShare = 0.25;
constexpr double kFolded = 0.02;  // The same of a fold: two sides on one circle are rounded.

// In parts of its length: an edge whose middle is off the geometry by less is straight.
constexpr double kStraight = 1e-6;

bool looks_the_same_way(const Corners& p, const Vec3& normal)
{
  const Vec3 own = normal_of(p);
  return dot(own, normal) > kLeastCosine * norm(own) * norm(normal);
}

class FoldMender {
 public:
  explicit FoldMender(SurfaceGroups& groups)
      : groups_(groups),
        surface_(groups.surface(), std::vector<double>(groups.surface().vertex_xyz.size(), 0.0))
  {
  }

  // Between two curves that meet: what is narrow there is the model's.
  [[nodiscard]] bool is_at_a_tip(LocalIndex t) const
  {
    const std::array<Edge, 3> all = sides(surface_.triangle(t));
    return std::ranges::count_if(
               all, [&](const Edge& edge) { return surface_.curve(edge[0], edge[1]) != kNoIndex; })
           > 1;
  }

  // Triangles with a child that looks the other way; if there are none, from here on also those
  // with one that is a needle.
  void find_first()
  {
    find();
    if (has_folds_) return;
    least_share_ = kLeastShare;
    find();
  }

  void find()
  {
    found_.clear();
    has_folds_ = false;
    for (LocalIndex t = 0; t < surface_.num_triangles(); ++t) {
      if (!surface_.is_triangle(t)) continue;
      const double share = smallest_share(surface_.triangle(t), surface_.patch(t));
      if (share <= least_share_ && !(share > kFolded && is_at_a_tip(t))) found_.push_back(t);
      has_folds_ = has_folds_ || share <= kFolded;
    }
  }

  [[nodiscard]] bool looks_for_needles() const { return least_share_ > kFolded; }
  [[nodiscard]] LocalIndex num_found() const { return static_cast<LocalIndex>(found_.size()); }
  [[nodiscard]] bool has_folds() const { return has_folds_; }

  // One step at each of the triangles found; whether anything was done.
  bool mend(FoldStatistics& done)
  {
    touched_.clear();
    const LocalIndex before = done.num_flips + done.num_cuts;
    for (const LocalIndex t : found_) {
      if (touched_.contains(t)) continue;
      if (flip_one_of(t)) {
        ++done.num_flips;
      } else if (cut_one_of(t)) {
        ++done.num_cuts;
      }
    }
    return done.num_flips + done.num_cuts > before;
  }

  [[nodiscard]] bool cuts_itself() const
  {
    return !find_overlaps(surface_.take(groups_.surface())).empty();
  }

  [[nodiscard]] const EditableSurface& surface() const { return surface_; }

 private:
  static std::array<Edge, 3> sides(const Triangle& v)
  {
    return {mesh::sorted_edge(v[0], v[1]), mesh::sorted_edge(v[1], v[2]),
            mesh::sorted_edge(v[2], v[0])};
  }

  [[nodiscard]] Corners corners(const Triangle& v) const
  {
    return {surface_.xyz(v[0]), surface_.xyz(v[1]), surface_.xyz(v[2])};
  }

  [[nodiscard]] Vec3 chord(const Edge& edge) const
  {
    return midpoint(surface_.xyz(edge[0]), surface_.xyz(edge[1]));
  }

  // Where refinement puts the vertex of an edge, which may be one that is not there yet.
  [[nodiscard]] Vec3 middle_of(const Edge& edge, LocalIndex group)
  {
    const auto known = middles_.find(edge);
    if (known != middles_.end()) return known->second;
    return middles_.emplace(edge, found_middle(edge, group)).first->second;
  }

  // What cannot be projected is no reason to leave the other folds: it counts as straight.
  [[nodiscard]] Vec3 found_middle(const Edge& edge, LocalIndex group)
  {
    const LocalIndex curve = surface_.curve(edge[0], edge[1]);
    const auto middle = projections_.run<GeometryError>([&] {
      return curve == kNoIndex ? on_group(edge, group)
                               : groups_.on_curve(curve, end_on(curve, edge), chord(edge));
    });
    return middle.value_or(chord(edge));
  }

  // At a seam, parameters of a vertex may be those of its other side. The search ends near them.
  [[nodiscard]] Vec3 on_group(const Edge& edge, LocalIndex group) const
  {
    const Vec3 from = chord(edge);
    for (const LocalIndex end : edge) {
      if (surface_.freedom(end) == Freedom::patch) return groups_.on_group(group, end, from);
    }
    const Vec3 a = groups_.on_group(group, edge[0], from);
    const Vec3 b = groups_.on_group(group, edge[1], from);
    return norm(b - from) < norm(a - from) ? b : a;
  }

  // Where a closed curve begins, its parameter is not known.
  [[nodiscard]] LocalIndex end_on(LocalIndex curve, const Edge& edge) const
  {
    return groups_.is_seam(curve, edge[0]) ? edge[1] : edge[0];
  }

  [[nodiscard]] double height(const Edge& edge, LocalIndex group)
  {
    return norm(middle_of(edge, group) - chord(edge));
  }

  [[nodiscard]] std::array<Corners, 4> children(const Triangle& v, LocalIndex group)
  {
    const auto [ab, bc, ca] = sides(v);
    return children_of(corners(v),
                       {middle_of(ab, group), middle_of(bc, group), middle_of(ca, group)});
  }

  // Of the area that a child should have, seen along the normal; below 0 one looks the other way.
  [[nodiscard]] double smallest_share(const Triangle& v, LocalIndex group)
  {
    const double of_children = share_of_children(v, group);
    const double of_corners = share_of_corners(v, group);
    return of_corners <= kFolded ? std::min(of_children, of_corners) : of_children;
  }

  // Of the first level.
  [[nodiscard]] double share_of_children(const Triangle& v, LocalIndex group)
  {
    const Vec3 normal = normal_of(corners(v));
    double smallest = std::numeric_limits<double>::infinity();
    for (const Corners& child : children(v, group)) {
      smallest = std::min(smallest, 4.0 * dot(normal_of(child), normal) / dot(normal, normal));
    }
    return smallest;
  }

  // The more levels there are, the closer the children in the corners follow the tangents there.
  [[nodiscard]] double share_of_corners(const Triangle& v, LocalIndex group)
  {
    const Corners p = corners(v);
    const Vec3 normal = normal_of(p);
    std::array<Vec3, 3> turns{};
    for (std::size_t c = 0; c < 3; ++c) {
      const Edge side = mesh::sorted_edge(v[c], v[(c + 1) % 3]);
      turns[c] = arc_turn(p[(c + 1) % 3] - p[c], middle_of(side, group) - chord(side));
    }
    double smallest = std::numeric_limits<double>::infinity();
    for (std::size_t c = 0; c < 3; ++c) {
      const LocalIndex before = v[(c + 2) % 3];
      const Vec3 next = p[(c + 1) % 3] - p[c];
      const Vec3 last = p[(c + 2) % 3] - p[c];
      if (dot(next, last) > 0.0 && are_on_two_curves({before, v[c]}, {v[c], v[(c + 1) % 3]})) {
        continue;
      }
      const Vec3 area = cross(next + turns[c], last + turns[(c + 2) % 3]);
      smallest = std::min(smallest, dot(area, normal) / dot(normal, normal));
    }
    return smallest;
  }

  // What is narrow between them is the model's.
  [[nodiscard]] bool are_on_two_curves(const Edge& one, const Edge& other) const
  {
    const LocalIndex curve = surface_.curve(one[0], one[1]);
    const LocalIndex next = surface_.curve(other[0], other[1]);
    return curve != kNoIndex && next != kNoIndex && curve != next;
  }

  [[nodiscard]] bool is_sound(const Triangle& v, LocalIndex group)
  {
    return smallest_share(v, group) > least_share_;
  }

  [[nodiscard]] bool is_straight(const Edge& edge, LocalIndex group)
  {
    return height(edge, group) <= kStraight * norm(surface_.xyz(edge[1]) - surface_.xyz(edge[0]));
  }

  // Highest arc first.
  [[nodiscard]] std::vector<Edge> by_height(LocalIndex t)
  {
    std::vector<std::pair<double, Edge>> heights;
    for (const Edge& edge : sides(surface_.triangle(t))) {
      heights.emplace_back(-height(edge, surface_.patch(t)), edge);
    }
    std::ranges::sort(heights);
    std::vector<Edge> edges;
    for (const auto& [minus, edge] : heights) edges.push_back(edge);
    return edges;
  }

  bool flip_one_of(LocalIndex t)
  {
    return std::ranges::any_of(by_height(t), [this](const Edge& edge) { return flip(edge); });
  }

  bool cut_one_of(LocalIndex t)
  {
    return std::ranges::any_of(by_height(t),
                               [&](const Edge& edge) { return cut(edge, surface_.patch(t)); });
  }

  [[nodiscard]] bool are_free(std::span<const LocalIndex> triangles) const
  {
    return std::ranges::none_of(triangles, [this](LocalIndex t) { return touched_.contains(t); });
  }

  bool flip(const Edge& edge)
  {
    const auto flip = surface_.flipped(edge);
    if (!flip || !are_free(flip->triangles)) return false;
    const auto& two = flip->triangles;
    const LocalIndex group = surface_.patch(two[0]);
    const Vec3 normal = normal_of(surface_.corners(two[0])) + normal_of(surface_.corners(two[1]));
    const bool are_sound = std::ranges::all_of(flip->made, [&](const Triangle& v) {
      return looks_the_same_way(corners(v), normal) && is_sound(v, group);
    });
    if (!are_sound) return false;
    surface_.flip(*flip);
    touched_.insert(two.begin(), two.end());
    return true;
  }

  // Whether a triangle looks the same way when a corner of it goes elsewhere.
  [[nodiscard]] bool may_move(LocalIndex t, LocalIndex corner, const Vec3& to) const
  {
    const Corners whole = surface_.corners(t);
    Corners moved = whole;
    for (std::size_t c = 0; c < 3; ++c) {
      if (surface_.triangle(t)[c] == corner) moved[c] = to;
    }
    return looks_the_same_way(moved, normal_of(whole));
  }

  // Whether the triangle beyond a side of `t` can take in a vertex of `edge` that lies there.
  [[nodiscard]] bool may_take_in(const Edge& side, LocalIndex t, const Edge& edge,
                                 const Vec3& point) const
  {
    const std::vector<LocalIndex> two = surface_.triangles_at(side);
    if (two.size() != 2 || surface_.curve(side[0], side[1]) != kNoIndex || !are_free(two)) {
      return false;
    }
    const LocalIndex other = two[0] == t ? two[1] : two[0];
    const LocalIndex far = opposite(surface_.triangle(other), side);  // To get an edge to `point`.
    const auto has_far = [&](LocalIndex u) { return holds(surface_.triangle(u), far); };
    return std::ranges::none_of(surface_.triangles_at(edge), has_far)
           && may_move(other, side[0], point) && may_move(other, side[1], point);
  }

  // The new vertex may lie beyond one side of one triangle. Then that side is flipped to it.
  bool cut(const Edge& edge, LocalIndex group)
  {
    const Vec3 point = middle_of(edge, group);
    const std::vector<LocalIndex> around = surface_.triangles_at(edge);
    if (is_straight(edge, group) || groups_.is_on_several_curves(edge) || !are_free(around)) {
      return false;
    }
    std::optional<Edge> beyond;
    for (const LocalIndex t : around) {
      for (const LocalIndex end : edge) {
        if (may_move(t, end, point)) continue;
        const LocalIndex kept = end == edge[0] ? edge[1] : edge[0];
        const Edge side = mesh::sorted_edge(opposite(surface_.triangle(t), edge), kept);
        if (beyond || !may_take_in(side, t, edge, point)) return false;
        beyond = side;
      }
    }
    const LocalIndex curve = surface_.curve(edge[0], edge[1]);
    const LocalIndex middle = surface_.split(edge, point);
    if (curve != kNoIndex) groups_.place_on_curve(curve, middle, end_on(curve, edge), point);
    for (const LocalIndex t : surface_.triangles_of(middle)) {
      groups_.place_on_group(surface_.patch(t), middle, edge[0], point);
    }
    if (beyond) surface_.flip(*surface_.flipped(*beyond));
    const std::span<const LocalIndex> changed = surface_.triangles_of(middle);
    touched_.insert(changed.begin(), changed.end());
    return true;
  }

  SurfaceGroups& groups_;
  EditableSurface surface_;
  std::map<Edge, Vec3> middles_{};  // Of all edges that were asked for; no vertex moves.
  Attempts projections_{"middles of edges on the geometry, to find folds"};
  std::vector<LocalIndex> found_{};
  bool has_folds_ = false;
  double least_share_ = kFolded;    // What a child must have more of.
  std::set<LocalIndex> touched_{};  // Triangles that this round has changed.
};

// What was done, and whether it was done to folds.
struct Mended {
  FoldStatistics statistics{};
  bool had_folds = false;
};

// Whether what was found has become less, without a cut of the surface or a fold for a needle.
bool is_better(const FoldMender& mender, const FoldStatistics& done, const FoldStatistics& kept)
{
  return done.num_left < kept.num_left && !mender.cuts_itself()
         && !(mender.has_folds() && mender.looks_for_needles());
}

// Folds, or needles of a surface without folds, which gets none.
Mended mend(CoarseSurface& surface, const model::Model& model)
{
  SurfaceGroups groups(surface, model);
  FoldMender mender(groups);
  mender.find_first();
  const bool had_folds = !mender.looks_for_needles();
  if (is_left_out(had_folds ? Repair::mend_folds : Repair::mend_needles)) return {{}, had_folds};
  FoldStatistics kept{.num_before = mender.num_found(), .num_left = mender.num_found()};
  FoldStatistics done = kept;
  CoarseSurface best;
  try {
    for (int round = 0; round < kRounds && done.num_left > 0 && mender.mend(done); ++round) {
      mender.find();
      done.num_left = mender.num_found();
      if (!is_better(mender, done, kept)) continue;
      best = groups.take(mender.surface());
      kept = done;
    }
  } catch (const GeometryError& error) {  // A needle is no reason to lose the surface.
    if (had_folds) throw;
    note_given_up("needles of the coarse surface", error);
  }
  if (kept.num_left < kept.num_before) surface = std::move(best);
  return {kept, had_folds};
}

// None of what is left of them counts.
void add_needles(const FoldStatistics& needles, FoldStatistics& folds)
{
  folds.num_flips += needles.num_flips;
  folds.num_cuts += needles.num_cuts;
  folds.num_steps_of_needles += needles.num_flips + needles.num_cuts;
}

}  // namespace

FoldStatistics mend_folds(CoarseSurface& surface, const model::Model& model)
{
  const Mended first = mend(surface, model);
  FoldStatistics done;
  if (!first.had_folds) {
    add_needles(first.statistics, done);
    return done;
  }
  done = first.statistics;
  if (done.num_left == 0) add_needles(mend(surface, model).statistics, done);
  return done;
}

}  // namespace tessera::surface
