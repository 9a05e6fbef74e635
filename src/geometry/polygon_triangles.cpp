// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/polygon_triangles.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

namespace tessera::geometry {
namespace {

using Point = PlaneMesh::Point;
using Triangle = PlaneMesh::Triangle;
using Loop = PlaneMesh::Loop;
using Edge = std::pair<LocalIndex, LocalIndex>;

// Twice the area of a triangle, with its sign.
double turn(const Point& a, const Point& b, const Point& c)
{
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

double squared_distance(const Point& a, const Point& b)
{
  const double x = a[0] - b[0];
  const double y = a[1] - b[1];
  return x * x + y * y;
}

// Whether two segments have a common point other than an end of both.
bool cross(const Point& a, const Point& b, const Point& c, const Point& d)
{
  if (a == c || a == d || b == c || b == d) return false;
  const double to_c = turn(a, b, c);
  const double to_d = turn(a, b, d);
  const double to_a = turn(c, d, a);
  const double to_b = turn(c, d, b);
  if (to_c == 0.0 && to_d == 0.0) {
    const auto [low, high] = std::minmax(a, b);
    return (low < c && c < high) || (low < d && d < high);
  }
  return to_c * to_d <= 0.0 && to_a * to_b <= 0.0;
}

class EarCutter {
 public:
  EarCutter(const std::vector<Point>& points, const std::vector<Loop>& loops)
      : points_(points), loops_(loops)
  {
  }

  std::vector<Triangle> run()
  {
    if (loops_.empty() || crosses_itself()) return {};
    Loop ring = loops_.front();
    std::vector<std::size_t> holes;
    for (std::size_t h = 1; h < loops_.size(); ++h) holes.push_back(h);
    // From right to left: then no later hole lies between a hole and what is joined already.
    std::ranges::sort(holes, [this](std::size_t a, std::size_t b) {
      return point(rightmost(loops_[a])) > point(rightmost(loops_[b]));
    });
    for (const std::size_t h : holes) {
      if (!join(ring, loops_[h])) return {};
    }
    return cut(std::move(ring));
  }

 private:
  [[nodiscard]] const Point& point(LocalIndex v) const { return points_[at(v)]; }

  [[nodiscard]] bool crosses_itself() const
  {
    std::vector<std::array<Point, 2>> sides;
    for (const Loop& loop : loops_) {
      for (std::size_t i = 0; i < loop.size(); ++i) {
        sides.push_back({point(loop[i]), point(loop[(i + 1) % loop.size()])});
      }
    }
    for (std::size_t i = 0; i < sides.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        if (cross(sides[i][0], sides[i][1], sides[j][0], sides[j][1])) return true;
      }
    }
    return false;
  }

  [[nodiscard]] LocalIndex rightmost(const Loop& loop) const
  {
    return *std::ranges::max_element(
        loop, [this](LocalIndex a, LocalIndex b) { return point(a) < point(b); });
  }

  // Makes one ring of a ring and a hole, by a bridge there and back that crosses nothing.
  bool join(Loop& ring, const Loop& hole) const
  {
    const auto start = std::ranges::find(hole, rightmost(hole));
    std::vector<std::size_t> ends(ring.size());
    for (std::size_t i = 0; i < ends.size(); ++i) ends[i] = i;
    std::ranges::sort(ends, [&](std::size_t a, std::size_t b) {
      return squared_distance(point(ring[a]), point(*start))
             < squared_distance(point(ring[b]), point(*start));
    });
    for (const std::size_t end : ends) {
      if (!sees(ring, end, point(*start)) || is_crossed(ring, point(ring[end]), point(*start))) {
        continue;
      }
      Loop bridge(start, hole.end());
      bridge.insert(bridge.end(), hole.begin(), start);
      bridge.push_back(*start);
      bridge.push_back(ring[end]);
      ring.insert(ring.begin() + static_cast<std::ptrdiff_t>(end) + 1, bridge.begin(),
                  bridge.end());
      return true;
    }
    return false;
  }

  // Whether a corner of the ring has the point on its inner side: bridges give a place two corners.
  [[nodiscard]] bool sees(const Loop& ring, std::size_t corner, const Point& target) const
  {
    const Point& here = point(ring[corner]);
    const Point& before = point(ring[(corner + ring.size() - 1) % ring.size()]);
    const Point& after = point(ring[(corner + 1) % ring.size()]);
    const bool is_left_of_both =
        turn(before, here, target) >= 0.0 && turn(here, after, target) >= 0.0;
    const bool is_left_of_one =
        turn(before, here, target) >= 0.0 || turn(here, after, target) >= 0.0;
    return turn(before, here, after) >= 0.0 ? is_left_of_both : is_left_of_one;
  }

  [[nodiscard]] bool is_crossed(const Loop& ring, const Point& a, const Point& b) const
  {
    const auto crosses_side_of = [&](const Loop& loop) {
      for (std::size_t i = 0; i < loop.size(); ++i) {
        if (cross(a, b, point(loop[i]), point(loop[(i + 1) % loop.size()]))) return true;
      }
      return false;
    };
    return crosses_side_of(ring) || std::any_of(loops_.begin() + 1, loops_.end(), crosses_side_of);
  }

  [[nodiscard]] std::vector<Triangle> cut(Loop ring) const
  {
    std::vector<Triangle> triangles;
    std::size_t i = 0;
    for (std::size_t without = 0; ring.size() > 3 && without <= ring.size(); ++without) {
      i %= ring.size();
      const Triangle ear = corner(ring, i);
      if (is_ear(ring, ear)) {
        triangles.push_back(ear);
        ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(i));
        without = 0;
      }
      ++i;  // Also after an ear: a fan from one corner has thin triangles.
    }
    if (ring.size() > 3 || turn_of(corner(ring, 1)) < 0.0) return {};
    triangles.push_back(corner(ring, 1));
    return triangles;
  }

  [[nodiscard]] static Triangle corner(const Loop& ring, std::size_t i)
  {
    return {ring[(i + ring.size() - 1) % ring.size()], ring[i], ring[(i + 1) % ring.size()]};
  }

  [[nodiscard]] double turn_of(const Triangle& t) const
  {
    return turn(point(t[0]), point(t[1]), point(t[2]));
  }

  [[nodiscard]] bool is_ear(const Loop& ring, const Triangle& ear) const
  {
    if (turn_of(ear) <= 0.0)
      return point(ear[0]) == point(ear[1]) || point(ear[1]) == point(ear[2]);
    const std::array<Point, 3> p{point(ear[0]), point(ear[1]), point(ear[2])};
    return std::ranges::none_of(ring, [&](LocalIndex v) {
      const Point& q = point(v);
      if (q == p[0] || q == p[1] || q == p[2]) return false;
      return turn(p[0], p[1], q) >= 0.0 && turn(p[1], p[2], q) >= 0.0 && turn(p[2], p[0], q) >= 0.0;
    });
  }

  const std::vector<Point>& points_;
  const std::vector<Loop>& loops_;
};

// Changes the triangles on both sides of inner edges.
class EdgeChanger {
 public:
  explicit EdgeChanger(PlaneMesh& mesh) : mesh_(mesh) {}

  // Ends: each swap makes the triangulation more Delaunay; the bound is for rounding alone.
  void swap_to_delaunay()
  {
    const std::size_t most_rounds = 20 + mesh_.triangles.size();
    for (std::size_t round = 0; round < most_rounds; ++round) {
      if (!change([this](const Edge& edge, const Sides& sides) { return swap(edge, sides); }))
        break;
    }
  }

  // Whether an edge was halved.
  template <class IsBad>
  bool halve(const IsBad& is_bad, std::size_t most_points)
  {
    return change([&](const Edge& edge, const Sides& sides) {
      if (mesh_.points.size() >= most_points || is_too_near_border(edge, sides)) return false;
      if (!is_bad(point(edge.first), point(edge.second))) return false;
      split(edge, sides);
      return true;
    });
  }

 private:
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);
  using Sides = std::array<std::size_t, 2>;  // Triangles left and right of an edge.

  [[nodiscard]] const Point& point(LocalIndex v) const { return mesh_.points[at(v)]; }

  template <class Change>
  bool change(const Change& change_edge)
  {
    std::map<Edge, Sides> edges;
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
      for (std::size_t c = 0; c < 3; ++c) {
        const LocalIndex a = mesh_.triangles[t][c];
        const LocalIndex b = mesh_.triangles[t][(c + 1) % 3];
        auto& sides = edges.try_emplace(std::minmax(a, b), Sides{kNone, kNone}).first->second;
        sides[a < b ? 0 : 1] = t;
      }
    }
    borders_.clear();
    for (const auto& [edge, sides] : edges) {
      if (sides[0] == kNone || sides[1] == kNone) borders_.insert(edge);
    }
    std::vector<char> is_old(mesh_.triangles.size(), 1);
    bool has_changed = false;
    for (const auto& [edge, sides] : edges) {
      if (sides[0] == kNone || sides[1] == kNone) continue;
      if (is_old[sides[0]] == 0 || is_old[sides[1]] == 0) continue;
      if (!change_edge(edge, sides)) continue;
      is_old[sides[0]] = is_old[sides[1]] = 0;
      has_changed = true;
    }
    return has_changed;
  }

  // Whether the middle of an edge is in the circle over a side of the polygon: sides stay whole, so
  // ever more points would come ever nearer to it.
  [[nodiscard]] bool is_too_near_border(const Edge& edge, const Sides& sides) const
  {
    const Point& p = point(edge.first);
    const Point& q = point(edge.second);
    const Point middle{0.5 * (p[0] + q[0]), 0.5 * (p[1] + q[1])};
    for (const std::size_t t : sides) {
      const LocalIndex corner = opposite(edge, t);
      for (const LocalIndex end : {edge.first, edge.second}) {
        if (!borders_.contains(std::minmax(corner, end))) continue;
        const Point& a = point(corner);
        const Point& b = point(end);
        const double along =
            (a[0] - middle[0]) * (b[0] - middle[0]) + (a[1] - middle[1]) * (b[1] - middle[1]);
        if (along < 0.0) return true;
      }
    }
    return false;
  }

  [[nodiscard]] LocalIndex opposite(const Edge& edge, std::size_t triangle) const
  {
    const Triangle& t = mesh_.triangles[triangle];
    return *std::ranges::find_if(t,
                                 [&](LocalIndex v) { return v != edge.first && v != edge.second; });
  }

  [[nodiscard]] double angle(LocalIndex corner, const Edge& ends) const
  {
    const Point& p = point(corner);
    const Point& a = point(ends.first);
    const Point& b = point(ends.second);
    const double along = (a[0] - p[0]) * (b[0] - p[0]) + (a[1] - p[1]) * (b[1] - p[1]);
    return std::atan2(std::abs(turn(p, a, b)), along);
  }

  bool swap(const Edge& edge, const Sides& sides)
  {
    constexpr double kRounding = 1e-9;  // Radians.
    const auto [a, b] = edge;
    const LocalIndex left = opposite(edge, sides[0]);
    const LocalIndex right = opposite(edge, sides[1]);
    if (left == right) return false;
    if (angle(left, edge) + angle(right, edge) <= M_PI + kRounding) return false;
    if (turn(point(right), point(b), point(left)) <= 0.0) return false;
    if (turn(point(left), point(a), point(right)) <= 0.0) return false;
    mesh_.triangles[sides[0]] = {right, b, left};
    mesh_.triangles[sides[1]] = {left, a, right};
    return true;
  }

  void split(const Edge& edge, const Sides& sides)
  {
    const auto [a, b] = edge;
    const LocalIndex left = opposite(edge, sides[0]);
    const LocalIndex right = opposite(edge, sides[1]);
    const auto middle = static_cast<LocalIndex>(mesh_.points.size());
    const Point p = point(a);
    const Point q = point(b);
    mesh_.points.push_back({0.5 * (p[0] + q[0]), 0.5 * (p[1] + q[1])});
    mesh_.triangles[sides[0]] = {a, middle, left};
    mesh_.triangles[sides[1]] = {b, middle, right};
    mesh_.triangles.push_back({middle, b, left});
    mesh_.triangles.push_back({middle, a, right});
  }

  PlaneMesh& mesh_;
  std::set<Edge> borders_{};
};

}  // namespace

PlaneMesh triangulate_polygon(std::vector<Point> points, const std::vector<Loop>& loops)
{
  PlaneMesh mesh;
  mesh.triangles = EarCutter(points, loops).run();
  mesh.points = std::move(points);
  EdgeChanger(mesh).swap_to_delaunay();
  return mesh;
}

void refine_inside(PlaneMesh& mesh, const std::function<bool(const Point&, const Point&)>& is_bad,
                   std::size_t most_points)
{
  EdgeChanger changer(mesh);
  while (mesh.points.size() < most_points && changer.halve(is_bad, most_points)) {
    changer.swap_to_delaunay();
  }
}

}  // namespace tessera::geometry
