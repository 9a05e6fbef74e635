// SPDX-License-Identifier: BSD-3-Clause
#include "cut/section.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <tuple>
#include <utility>

#include "tessera/base/union_find.hpp"

#include "cut/edge_crossings.hpp"
#include "cut/line_intervals.hpp"

namespace tessera::cut {
namespace {

class Sectioner {
 public:
  Sectioner(const PartSurface& part, const Plane& plane, const std::vector<double>& heights,
            double noise)
      : part_(part), plane_(plane), heights_(heights), crossings_(part, heights), noise_(noise)
  {
  }

  Section run()
  {
    for (const FeatureEdge& edge : part_.edges) cross_curve(edge);
    for (const SurfaceTriangle& triangle : part_.triangles) cross_face(triangle);
    for (const Cap& cap : part_.caps) cross_cap(cap);
    section_.shortest_edge = shortest_edge();
    section_.area = std::abs(section_.area);
    const double sine =
        std::min(smallest_sine_, std::sqrt(1.0 - largest_cosine_ * largest_cosine_));
    section_.angle_deg = std::asin(std::clamp(sine, 0.0, 1.0)) * 180.0 / std::numbers::pi;
    return section_;
  }

 private:
  struct Segment {
    LocalIndex from = kNoIndex;
    LocalIndex to = kNoIndex;
    double length = 0.0;
  };

  [[nodiscard]] bool is_below(LocalIndex v) const { return crossings_.is_below(v); }

  // Number of the point at which the plane crosses an edge.
  LocalIndex crossing(LocalIndex a, LocalIndex b)
  {
    const LocalIndex number = crossings_.row(a, b, points_);
    is_corner_.resize(points_.size(), false);
    return number;
  }

  void cross_curve(const FeatureEdge& edge)
  {
    const auto [a, b] = edge.vertices;
    if (is_below(a) == is_below(b)) return;
    const LocalIndex corner = crossing(a, b);
    is_corner_[at(corner)] = true;
    if (edge.foreign != kNoIndex) foreign_.push_back({edge.faces[0], corner});
    const double length = norm(part_.points[at(b)] - part_.points[at(a)]);
    if (length < noise_) return;
    smallest_sine_ = std::min(smallest_sine_, std::abs(heights_[at(b)] - heights_[at(a)]) / length);
  }

  void cross_face(const SurfaceTriangle& triangle)
  {
    auto [a, b, c] = triangle.vertices;
    if (is_below(a) == is_below(b) && is_below(b) == is_below(c)) return;
    while (is_below(b) != is_below(c)) std::tie(a, b, c) = std::tuple(b, c, a);
    const LocalIndex p = crossing(a, b);
    const LocalIndex q = crossing(c, a);
    if (is_below(a)) {
      add_segment(q, p);
    } else {
      add_segment(p, q);
    }
    if (segments_.back().length < noise_) return;
    const Vec3 origin = part_.points[at(a)];
    const Vec3 normal = cross(part_.points[at(b)] - origin, part_.points[at(c)] - origin);
    largest_cosine_ =
        std::max(largest_cosine_, std::abs(dot(normal, plane_.normal)) / norm(normal));
  }

  void cross_cap(const Cap& cap)
  {
    const Vec3 line = cross(plane_.normal, cap.normal);
    std::vector<LineCrossing> trace;
    for (const auto& [a, b] : cap.border) {
      if (is_below(a) == is_below(b)) continue;
      const LocalIndex p = crossing(a, b);
      is_corner_[at(p)] = true;
      trace.push_back({dot(line, points_[at(p)]), p, is_below(b)});
    }
    if (trace.empty()) return;
    largest_cosine_ = std::max(largest_cosine_, std::abs(dot(cap.normal, plane_.normal)));
    for_each_interval(std::move(trace),
                      [&](LocalIndex from, LocalIndex to) { add_trace(to, from, cap.label); });
  }

  // Lines of others on a cap divide what is between its borders.
  void add_trace(LocalIndex from, LocalIndex to, LocalIndex label)
  {
    const Vec3 along = points_[at(to)] - points_[at(from)];
    const auto place = [&](LocalIndex point) {
      return dot(points_[at(point)] - points_[at(from)], along);
    };
    std::vector<LocalIndex> stops;
    for (const auto& [face, point] : foreign_) {
      if (face == label && place(point) > 0.0 && place(point) < dot(along, along)) {
        stops.push_back(point);
      }
    }
    std::ranges::sort(stops, {}, [&](LocalIndex point) { return std::pair(place(point), point); });
    stops.push_back(to);
    for (const LocalIndex stop : stops) {
      add_segment(from, stop);
      from = stop;
    }
  }

  // In the direction that goes around the part below.
  void add_segment(LocalIndex from, LocalIndex to)
  {
    segments_.push_back({from, to, norm(points_[at(to)] - points_[at(from)])});
    section_.perimeter += segments_.back().length;
    const Vec3& origin = points_.front();
    section_.area +=
        0.5 * dot(plane_.normal, cross(points_[at(from)] - origin, points_[at(to)] - origin));
  }

  // Segments between two corners are one edge; a loop without corners is one, too.
  double shortest_edge()
  {
    UnionFind edges(static_cast<LocalIndex>(segments_.size()));
    std::vector<LocalIndex> segment_at(points_.size(), kNoIndex);
    for (LocalIndex i = 0; i < static_cast<LocalIndex>(segments_.size()); ++i) {
      for (const LocalIndex point : {segments_[at(i)].from, segments_[at(i)].to}) {
        if (is_corner_[at(point)]) continue;
        if (segment_at[at(point)] != kNoIndex) edges.join(segment_at[at(point)], i);
        segment_at[at(point)] = i;
      }
    }
    std::vector<double> length(segments_.size(), 0.0);
    for (LocalIndex i = 0; i < static_cast<LocalIndex>(segments_.size()); ++i) {
      length[at(edges.find(i))] += segments_[at(i)].length;
    }
    double shortest = std::numeric_limits<double>::infinity();
    for (LocalIndex i = 0; i < static_cast<LocalIndex>(segments_.size()); ++i) {
      if (edges.find(i) == i) shortest = std::min(shortest, length[at(i)]);
    }
    return shortest;
  }

  const PartSurface& part_;
  const Plane& plane_;
  const std::vector<double>& heights_;
  EdgeCrossings crossings_;
  double noise_;
  std::vector<Vec3> points_{};
  std::vector<bool> is_corner_{};
  std::vector<std::array<LocalIndex, 2>>
      foreign_{};  // Where lines of others are crossed: face, point.
  std::vector<Segment> segments_{};
  double smallest_sine_ = 1.0;
  double largest_cosine_ = 0.0;
  Section section_{};
};

}  // namespace

Section section_of(const PartSurface& part, const Plane& plane, const std::vector<double>& heights,
                   double coarse_size)
{
  return Sectioner(part, plane, heights, 1e-3 * coarse_size).run();
}

}  // namespace tessera::cut
