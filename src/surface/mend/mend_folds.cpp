// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/surface/mend_folds.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <map>
#include <memory>
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

#include "surface/angle_shape.hpp"
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

// The same of children in corners: two sides on one circle leave nothing, but for rounding.
constexpr double kLeastShareOfCorners = 0.02;

// By angle_shape(), of 15 degrees: what takes the place of a triangle whose corners fold. Without
// it 59 files of strangers had 0.92 of their smallest angles.
constexpr double kFairShape = 0.3;

// In parts of its length: an edge whose middle is off the geometry by less is straight.
constexpr double kStraight = 1e-6;

bool looks_the_same_way(const Corners& p, const Vec3& normal)
{
  const Vec3 own = normal_of(p);
  return dot(own, normal) > kLeastCosine * norm(own) * norm(normal);
}

// What is looked for, each only in a surface that has none of the first.
enum class Aim {
  folds,    // Children of the first level that look the other way.
  corners,  // Children in corners that do so after many levels.
  needles,  // Children of the first level that are nearly flat.
};

class FoldMender {
 public:
  FoldMender(const CoarseSurface& surface, const model::Model& model)
      : groups_(surface, model),
        surface_(groups_.surface(), std::vector<double>(groups_.surface().vertex_xyz.size(), 0.0))
  {
    find();
  }

  // What it mends from here on.
  void aim_at(Aim aim) { aim_ = aim; }

  void find()
  {
    for (std::vector<LocalIndex>& found : found_) found.clear();
    for (LocalIndex t = 0; t < surface_.num_triangles(); ++t) {
      if (!surface_.is_triangle(t)) continue;
      const Triangle& v = surface_.triangle(t);
      const double share = share_of_children(v, surface_.patch(t));
      if (share <= 0.0) of(Aim::folds).push_back(t);
      if (share_of_corners(v, surface_.patch(t)) <= kLeastShareOfCorners) {
        of(Aim::corners).push_back(t);
      }
      if (share <= 0.0 || (share <= kLeastShare && !is_at_a_tip(t))) of(Aim::needles).push_back(t);
    }
  }

  [[nodiscard]] LocalIndex num_found() { return static_cast<LocalIndex>(of(aim_).size()); }
  [[nodiscard]] bool has_folds() { return !of(Aim::folds).empty(); }
  // Whether its surface may be another than the one it was given.
  [[nodiscard]] bool has_tried() const { return has_tried_; }

  // One step at each of the triangles found; whether anything was done.
  bool mend(FoldStatistics& done)
  {
    has_tried_ = true;
    touched_.clear();
    const LocalIndex before = done.num_flips + done.num_cuts;
    for (const LocalIndex t : of(aim_)) {
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

  [[nodiscard]] CoarseSurface take() const { return groups_.take(surface_); }

 private:
  [[nodiscard]] std::vector<LocalIndex>& of(Aim aim)
  {
    return found_[static_cast<std::size_t>(aim)];
  }

  // Between two curves that meet: what is narrow there is the model's.
  [[nodiscard]] bool is_at_a_tip(LocalIndex t) const
  {
    const std::array<Edge, 3> all = sides(surface_.triangle(t));
    return std::ranges::count_if(
               all, [&](const Edge& edge) { return surface_.curve(edge[0], edge[1]) != kNoIndex; })
           > 1;
  }

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

  // The smallest one of the first level, of the area that a child should have, seen along the
  // normal. Below 0 one looks the other way.
  [[nodiscard]] double share_of_children(const Triangle& v, LocalIndex group)
  {
    const Vec3 normal = normal_of(corners(v));
    double smallest = std::numeric_limits<double>::infinity();
    for (const Corners& child : children(v, group)) {
      smallest = std::min(smallest, 4.0 * dot(normal_of(child), normal) / dot(normal, normal));
    }
    return smallest;
  }

  // The same of the children in the corners after many levels: these follow the tangents there.
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

  // Whether a triangle may take the place of one that was found.
  [[nodiscard]] bool is_sound(const Triangle& v, LocalIndex group)
  {
    if (aim_ == Aim::folds) return share_of_children(v, group) > 0.0;
    return share_of_children(v, group) > kLeastShare
           && (aim_ == Aim::needles
               || (share_of_corners(v, group) > kLeastShareOfCorners && is_fair(corners(v))));
  }

  [[nodiscard]] static bool is_fair(const Corners& p) { return angle_shape(p) >= kFairShape; }

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
    return looks_the_same_way(moved(t, corner, to), normal_of(surface_.corners(t)));
  }

  [[nodiscard]] Corners moved(LocalIndex t, LocalIndex corner, const Vec3& to) const
  {
    Corners p = surface_.corners(t);
    for (std::size_t c = 0; c < 3; ++c) {
      if (surface_.triangle(t)[c] == corner) p[c] = to;
    }
    return p;
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
        if (aim_ == Aim::corners && !is_fair(moved(t, end, point))) return false;
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

  SurfaceGroups groups_;
  EditableSurface surface_;
  std::map<Edge, Vec3> middles_{};  // Of all edges that were asked for; no vertex moves.
  Attempts projections_{"middles of edges on the geometry, to find folds"};
  std::array<std::vector<LocalIndex>, 3> found_{};  // Of each aim.
  Aim aim_ = Aim::folds;
  bool has_tried_ = false;
  std::set<LocalIndex> touched_{};  // Triangles that this round has changed.
};

// What has been done, and the surface with less of what was found, if that could be had.
struct Mended {
  FoldStatistics statistics{};
  std::optional<CoarseSurface> surface{};
};

// No step may cut the surface, or fold it for anything less.
Mended mend(FoldMender& mender, Aim aim)
{
  mender.aim_at(aim);
  FoldStatistics done{.num_before = mender.num_found(), .num_left = mender.num_found()};
  Mended best{done};
  for (int round = 0; round < kRounds && done.num_left > 0 && mender.mend(done); ++round) {
    mender.find();
    done.num_left = mender.num_found();
    const bool is_better = done.num_left < best.statistics.num_left && !mender.cuts_itself()
                           && (aim == Aim::folds || !mender.has_folds());
    if (is_better) best = {done, mender.take()};
  }
  return best;
}

// Corners and needles are no reason to lose the surface.
Mended mend_or_give_up(FoldMender& mender, Aim aim)
{
  if (is_left_out(aim == Aim::needles ? Repair::mend_needles : Repair::mend_folds)) return {};
  if (aim == Aim::folds) return mend(mender, aim);
  try {
    return mend(mender, aim);
  } catch (const GeometryError& error) {
    note_given_up(aim == Aim::needles ? "needles of the coarse surface"
                                      : "corners of the coarse surface that fold on fine levels",
                  error);
    return {};
  }
}

void add(const FoldStatistics& done, Aim aim, FoldStatistics& sum)
{
  sum.num_flips += done.num_flips;
  sum.num_cuts += done.num_cuts;
  if (aim == Aim::folds) {
    sum.num_before = done.num_before;
    sum.num_left = done.num_left;
  } else if (aim == Aim::needles) {
    sum.num_steps_of_needles = done.num_flips + done.num_cuts;
  }
}

}  // namespace

FoldStatistics mend_folds(CoarseSurface& surface, const model::Model& model)
{
  FoldStatistics sum;
  auto mender = std::make_unique<FoldMender>(surface, model);
  for (const Aim aim : {Aim::folds, Aim::corners, Aim::needles}) {
    Mended mended = mend_or_give_up(*mender, aim);
    add(mended.statistics, aim, sum);
    if (mended.surface) surface = std::move(*mended.surface);
    if (sum.num_left > 0) break;
    if (mender->has_tried()) mender = std::make_unique<FoldMender>(surface, model);
  }
  return sum;
}

}  // namespace tessera::surface
