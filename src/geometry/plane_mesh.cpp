// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/plane_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

namespace tessera::geometry {
namespace {

using Point = PlaneMesh::Point;
using Triangle = PlaneMesh::Triangle;
using Edge = std::pair<LocalIndex, LocalIndex>;

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

double signed_area(const std::vector<Point>& points, const PlaneMesh::Loop& loop)
{
  double area = 0.0;
  for (std::size_t i = 1; i + 1 < loop.size(); ++i) {
    area += 0.5 * turn(points[at(loop[0])], points[at(loop[i])], points[at(loop[i + 1])]);
  }
  return area;
}

double length_around(const std::vector<Point>& points, const PlaneMesh::Loop& loop)
{
  double length = 0.0;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Point& a = points[at(loop[i])];
    const Point& b = points[at(loop[(i + 1) % loop.size()])];
    length += std::hypot(b[0] - a[0], b[1] - a[1]);
  }
  return length;
}

void swap_to_delaunay(PlaneMesh& mesh) { EdgeChanger(mesh).swap_to_delaunay(); }

void refine_inside(PlaneMesh& mesh, const std::function<bool(const Point&, const Point&)>& is_bad,
                   std::size_t most_points)
{
  EdgeChanger changer(mesh);
  while (mesh.points.size() < most_points && changer.halve(is_bad, most_points)) {
    changer.swap_to_delaunay();
  }
}

}  // namespace tessera::geometry
