// SPDX-License-Identifier: BSD-3-Clause
#include <tuple>
#include <utility>

#include "cut/edge_crossings.hpp"
#include "cut/line_intervals.hpp"
#include "cut/part_surface.hpp"

namespace tessera::cut {
namespace {

// One side of a cut in the making, with the points that it uses in the order of their first use.
class Side {
 public:
  explicit Side(const std::vector<Vec3>& points) : points_(points) {}

  void add_triangle(const std::array<LocalIndex, 3>& vertices, const SurfaceTriangle& of)
  {
    surface_.triangles.push_back(
        {{own(vertices[0]), own(vertices[1]), own(vertices[2])}, of.face, of.neighbour});
  }

  void add_edge(LocalIndex a, LocalIndex b, const FeatureEdge& of)
  {
    surface_.edges.push_back({{own(a), own(b)}, of.faces, of.size, of.foreign});
  }

  void begin_cap(const Cap& of)
  {
    cap_ = {.normal = of.normal, .label = of.label, .is_upper = of.is_upper, .border = {}};
  }
  void add_border(LocalIndex a, LocalIndex b) { cap_.border.push_back({own(a), own(b)}); }
  void end_cap()
  {
    if (!cap_.border.empty()) surface_.caps.push_back(std::move(cap_));
  }

  PartSurface take() { return std::move(surface_); }

 private:
  LocalIndex own(LocalIndex point)
  {
    own_.resize(points_.size(), kNoIndex);
    LocalIndex& number = own_[at(point)];
    if (number == kNoIndex) {
      number = static_cast<LocalIndex>(surface_.points.size());
      surface_.points.push_back(points_[at(point)]);
    }
    return number;
  }

  const std::vector<Vec3>& points_;
  std::vector<LocalIndex> own_{};
  PartSurface surface_{};
  Cap cap_{};
};

class Cutter {
 public:
  Cutter(const PartSurface& part, const Plane& plane, LocalIndex label, double size)
      : part_(part),
        plane_(plane),
        label_(label),
        size_(size),
        points_(part.points),
        heights_(part.heights(plane))
  {
  }

  CutSides run()
  {
    for (const SurfaceTriangle& triangle : part_.triangles) cut_triangle(triangle);
    for (const FeatureEdge& edge : part_.edges) cut_edge(edge);
    for (const Cap& cap : part_.caps) cut_cap(cap);
    add_new_cap();
    return {below_.take(), above_.take(), std::move(traces_)};
  }

 private:
  [[nodiscard]] bool is_below(LocalIndex v) const { return crossings_.is_below(v); }
  Side& side_of(LocalIndex v) { return is_below(v) ? below_ : above_; }

  LocalIndex crossing(LocalIndex a, LocalIndex b) { return crossings_.row(a, b, points_); }

  void cut_triangle(const SurfaceTriangle& triangle)
  {
    auto [a, b, c] = triangle.vertices;
    if (is_below(a) == is_below(b) && is_below(b) == is_below(c)) {
      side_of(a).add_triangle(triangle.vertices, triangle);
      return;
    }
    // a is alone on its side.
    while (is_below(b) != is_below(c)) std::tie(a, b, c) = std::tuple(b, c, a);
    const LocalIndex p = crossing(a, b);
    const LocalIndex q = crossing(c, a);
    side_of(a).add_triangle({a, p, q}, triangle);
    side_of(b).add_triangle({p, b, c}, triangle);
    side_of(b).add_triangle({p, c, q}, triangle);
    add_section(is_below(a) ? std::array{q, p} : std::array{p, q}, triangle.face);
    if (triangle.neighbour == kNoIndex) return;
    traces_.push_back({.ends = {points_[at(p)], points_[at(q)]},
                       .face = triangle.face,
                       .neighbour = triangle.neighbour});
  }

  // A piece of the new cap's border, as it goes around the part below.
  void add_section(const std::array<LocalIndex, 2>& piece, LocalIndex face)
  {
    section_.push_back(piece);
    const FeatureEdge edge{piece, {face, label_}, size_};
    below_.add_edge(piece[0], piece[1], edge);
    above_.add_edge(piece[0], piece[1], edge);
  }

  void cut_edge(const FeatureEdge& edge)
  {
    const auto [a, b] = edge.vertices;
    if (is_below(a) == is_below(b)) {
      side_of(a).add_edge(a, b, edge);
      return;
    }
    const LocalIndex p = crossing(a, b);
    side_of(a).add_edge(a, p, edge);
    side_of(b).add_edge(p, b, edge);
  }

  void cut_cap(const Cap& cap)
  {
    const Vec3 line = cross(plane_.normal, cap.normal);
    std::vector<LineCrossing> trace;
    below_.begin_cap(cap);
    above_.begin_cap(cap);
    for (const auto& [a, b] : cap.border) {
      if (is_below(a) == is_below(b)) {
        side_of(a).add_border(a, b);
        continue;
      }
      const LocalIndex p = crossing(a, b);
      side_of(a).add_border(a, p);
      side_of(b).add_border(p, b);
      trace.push_back({dot(line, points_[at(p)]), p, is_below(b)});
    }
    for_each_interval(std::move(trace), [&](LocalIndex from, LocalIndex to) {
      below_.add_border(from, to);
      above_.add_border(to, from);
      add_section({to, from}, cap.label);
      traces_.push_back({.ends = {points_[at(from)], points_[at(to)]},
                         .face = cap.label,
                         .is_upper = cap.is_upper});
    });
    below_.end_cap();
    above_.end_cap();
  }

  void add_new_cap()
  {
    Cap cap{.normal = plane_.normal, .label = label_, .is_upper = false, .border = {}};
    below_.begin_cap(cap);
    cap.is_upper = true;
    above_.begin_cap(cap);
    for (const auto& [a, b] : section_) {
      below_.add_border(a, b);
      above_.add_border(b, a);
    }
    below_.end_cap();
    above_.end_cap();
  }

  const PartSurface& part_;
  const Plane& plane_;
  LocalIndex label_;
  double size_;
  std::vector<Vec3> points_;
  std::vector<double> heights_;
  EdgeCrossings crossings_{part_, heights_};
  std::vector<std::array<LocalIndex, 2>> section_{};
  std::vector<Trace> traces_{};
  Side below_{points_};
  Side above_{points_};
};

}  // namespace

CutSides cut_part(const PartSurface& part, const Plane& plane, LocalIndex label, double size)
{
  return Cutter(part, plane, label, size).run();
}

}  // namespace tessera::cut
