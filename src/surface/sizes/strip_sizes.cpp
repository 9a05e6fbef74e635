// SPDX-License-Identifier: BSD-3-Clause
#include "surface/sizes/strip_sizes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <queue>
#include <utility>

#include "tessera/base/box_tree.hpp"
#include "tessera/model/nearest_point.hpp"
#include "tessera/surface/defeature.hpp"

namespace tessera::surface {
namespace {

using Edge = EditableSurface::Edge;

// Along the curves, in parts of the distance in space: one that is as near as this is at a corner.
constexpr double kWayRoundCorner = 3.0;

struct CurveEdge {
  Edge edge{};
  std::vector<LocalIndex> patches{};  // On which it is, ascending.
};

class StripSizes {
 public:
  StripSizes(const EditableSurface& surface, const CoarseOptions& options)
      : surface_(surface),
        largest_(options.max_size),
        merged_(MergeLimits{.tolerance = options.defeature}.most()),
        edges_(edges_of(surface)),
        tree_(boxes_of(edges_))
  {
    for (const CurveEdge& one : edges_) {
      next_[one.edge[0]].push_back(one.edge[1]);
      next_[one.edge[1]].push_back(one.edge[0]);
    }
  }

  std::vector<SizeSource> run() &&
  {
    for (const CurveEdge& one : edges_) look(one);
    return std::move(sources_);
  }

 private:
  static std::vector<CurveEdge> edges_of(const EditableSurface& surface)
  {
    std::vector<CurveEdge> edges;
    for (const auto& [edge, curve] : surface.curves()) {
      CurveEdge& one = edges.emplace_back(CurveEdge{edge});
      for (const LocalIndex t : surface.triangles_at(edge)) one.patches.push_back(surface.patch(t));
      std::ranges::sort(one.patches);
    }
    return edges;
  }

  [[nodiscard]] std::array<Vec3, 2> ends(const Edge& edge) const
  {
    return {surface_.xyz(edge[0]), surface_.xyz(edge[1])};
  }

  [[nodiscard]] std::vector<Box> boxes_of(const std::vector<CurveEdge>& edges) const
  {
    std::vector<Box> boxes;
    for (const CurveEdge& one : edges) {
      boxes.push_back(box_of(ends(one.edge)));
    }
    return boxes;
  }

  void look(const CurveEdge& one)
  {
    const auto [a, b] = ends(one.edge);
    const Vec3 middle = midpoint(a, b);
    const double size = std::max(surface_.size(one.edge[0]), surface_.size(one.edge[1]));
    const double reach = size / kEdgesOfStrip;
    const Box box = Box{middle, middle}.widened(reach);
    std::vector<std::pair<double, LocalIndex>> near;
    tree_.visit([&](const Box& other) { return other.touches(box); },
                [&](LocalIndex other) {
                  const CurveEdge& found = edges_[at(other)];
                  if (found.edge == one.edge || !share_a_patch(one, found)) return;
                  const double apart =
                      norm(model::nearest_point_of(ends(found.edge), middle) - middle);
                  if (apart < reach) near.emplace_back(apart, other);
                });
    if (near.empty()) return;
    std::ranges::sort(near);
    const std::map<LocalIndex, double> ways = ways_from(one.edge, kWayRoundCorner * reach);
    for (const auto& [apart, other] : near) {
      if (apart <= merged_) continue;
      if (is_round_corner(ways, edges_[at(other)].edge, kWayRoundCorner * apart)) continue;
      sources_.push_back({{a, b, b}, size_beside(one.edge, apart)});
      return;
    }
  }

  [[nodiscard]] double size_beside(const Edge& edge, double width) const
  {
    const double least = std::min(kLeastOfStrip * largest_, flat_enough(edge, width));
    return std::max({kEdgesOfStrip * width, least, kLeastOfCurvedStrip * largest_});
  }

  // The edge whose arc is a quarter as high as the strip is wide; triangles across it would fold
  // where arcs are as high as that.
  [[nodiscard]] double flat_enough(const Edge& edge, double width) const
  {
    return std::sqrt(2.0 * std::min(radius_at(edge[0]), radius_at(edge[1])) * width);
  }

  // Of the circle through a vertex and its two neighbours along a curve.
  [[nodiscard]] double radius_at(LocalIndex v) const
  {
    const std::vector<LocalIndex>& two = next_.at(v);
    constexpr double kStraight = std::numeric_limits<double>::infinity();
    if (two.size() != 2 || surface_.freedom(v) != Freedom::curve) return kStraight;
    const Vec3 a = surface_.xyz(two[0]) - surface_.xyz(v);
    const Vec3 b = surface_.xyz(two[1]) - surface_.xyz(v);
    const double area2 = norm(cross(a, b));
    return area2 > 0.0 ? norm(a) * norm(b) * norm(b - a) / (2.0 * area2) : kStraight;
  }

  [[nodiscard]] static bool share_a_patch(const CurveEdge& a, const CurveEdge& b)
  {
    return std::ranges::any_of(
        a.patches, [&](LocalIndex patch) { return std::ranges::binary_search(b.patches, patch); });
  }

  // How far it is along curves from the middle of an edge to the vertices within `most`.
  [[nodiscard]] std::map<LocalIndex, double> ways_from(const Edge& edge, double most) const
  {
    using Place = std::pair<double, LocalIndex>;
    std::priority_queue<Place, std::vector<Place>, std::greater<>> queue;
    std::map<LocalIndex, double> ways;
    const auto [a, b] = ends(edge);
    for (const LocalIndex v : edge) queue.emplace(0.5 * norm(b - a), v);
    while (!queue.empty() && queue.top().first <= most) {
      const auto [way, v] = queue.top();
      queue.pop();
      if (!ways.emplace(v, way).second) continue;
      for (const LocalIndex other : next_.at(v)) {
        queue.emplace(way + norm(surface_.xyz(other) - surface_.xyz(v)), other);
      }
    }
    return ways;
  }

  [[nodiscard]] static bool is_round_corner(const std::map<LocalIndex, double>& ways,
                                            const Edge& to, double most)
  {
    return std::ranges::any_of(to, [&](LocalIndex v) {
      const auto found = ways.find(v);
      return found != ways.end() && found->second <= most;
    });
  }

  const EditableSurface& surface_;
  double largest_;
  double merged_;  // Widths up to this are.
  std::vector<CurveEdge> edges_;
  BoxTree tree_;
  std::map<LocalIndex, std::vector<LocalIndex>> next_{};  // Along curves.
  std::vector<SizeSource> sources_{};
};

}  // namespace

std::vector<SizeSource> narrow_strips_of(const EditableSurface& surface,
                                         const CoarseOptions& options)
{
  return StripSizes(surface, options).run();
}

}  // namespace tessera::surface
