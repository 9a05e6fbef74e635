// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/polygon_triangles.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <numeric>
#include <utility>

namespace tessera::geometry {
namespace {

using Point = PlaneMesh::Point;
using Triangle = PlaneMesh::Triangle;
using Loop = PlaneMesh::Loop;

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

class PolygonTriangulator {
 public:
  PolygonTriangulator(const std::vector<Point>& points, const std::vector<Loop>& loops,
                      double tolerance)
      : points_(points), loops_(loops), tolerance_(tolerance)
  {
  }

  std::vector<Triangle> run()
  {
    if (loops_.empty()) return {};
    Loop ring = loops_.front();
    std::vector<std::size_t> holes;
    for (std::size_t h = 1; h < loops_.size(); ++h) holes.push_back(h);
    // From right to left: then no later hole lies between a hole and what is joined already.
    std::ranges::sort(holes, [this](std::size_t a, std::size_t b) {
      return point(rightmost(loops_[a])) > point(rightmost(loops_[b]));
    });
    for (const std::size_t h : holes) join(ring, loops_[h]);
    std::vector<Triangle> triangles;
    for (const Loop& piece : pieces_of(std::move(ring))) {
      std::vector<Triangle> some = cut_ears(piece);
      if (some.size() + 2 < piece.size()) some = fill(piece);
      if (some.empty()) return {};
      triangles.insert(triangles.end(), some.begin(), some.end());
    }
    return triangles;
  }

 private:
  [[nodiscard]] const Point& point(LocalIndex v) const { return points_[at(v)]; }

  [[nodiscard]] LocalIndex rightmost(const Loop& loop) const
  {
    return *std::ranges::max_element(
        loop, [this](LocalIndex a, LocalIndex b) { return point(a) < point(b); });
  }

  // Makes one ring of a ring and a hole: at a common point, or by a bridge there and back, which
  // crosses nothing if there is such a one.
  void join(Loop& ring, const Loop& hole) const
  {
    const auto common = std::ranges::find_first_of(hole, ring);
    if (common != hole.end()) {
      Loop around(common + 1, hole.end());
      around.insert(around.end(), hole.begin(), common + 1);
      ring.insert(std::ranges::find(ring, *common) + 1, around.begin(), around.end());
      return;
    }
    const auto start = std::ranges::find(hole, rightmost(hole));
    std::vector<std::size_t> ends(ring.size());
    std::iota(ends.begin(), ends.end(), 0);
    std::ranges::sort(ends, [&](std::size_t a, std::size_t b) {
      return squared_distance(point(ring[a]), point(*start))
             < squared_distance(point(ring[b]), point(*start));
    });
    const auto is_free = [&](std::size_t end) {
      return sees(ring, end, point(*start)) && !is_crossed(ring, point(ring[end]), point(*start));
    };
    const auto first_free = std::ranges::find_if(ends, is_free);
    const std::size_t end = first_free == ends.end() ? ends.front() : *first_free;
    Loop bridge(start, hole.end());
    bridge.insert(bridge.end(), hole.begin(), start);
    bridge.push_back(*start);
    bridge.push_back(ring[end]);
    ring.insert(ring.begin() + static_cast<std::ptrdiff_t>(end) + 1, bridge.begin(), bridge.end());
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

  // Parts a ring where it comes to a point again, unless that is where a hole was joined to it.
  [[nodiscard]] std::vector<Loop> pieces_of(Loop ring) const
  {
    std::vector<Loop> pieces;
    std::vector<Loop> rings{std::move(ring)};
    while (!rings.empty()) {
      Loop whole = std::move(rings.back());
      rings.pop_back();
      if (auto [one, other] = parts_of(whole); !one.empty()) {
        rings.push_back(std::move(one));
        rings.push_back(std::move(other));
      } else if (whole.size() >= 3) {
        pieces.push_back(std::move(whole));
      }
    }
    return pieces;
  }

  // Nothing if the ring cannot be parted.
  [[nodiscard]] std::pair<Loop, Loop> parts_of(const Loop& ring) const
  {
    std::map<LocalIndex, std::size_t> last_place;
    for (std::size_t j = 0; j < ring.size(); ++j) {
      const auto [before, is_first] = last_place.try_emplace(ring[j], j);
      if (is_first) continue;
      const auto from = ring.begin() + static_cast<std::ptrdiff_t>(before->second);
      const auto to = ring.begin() + static_cast<std::ptrdiff_t>(j);
      const Loop one(from, to);
      Loop other(to, ring.end());
      other.insert(other.end(), ring.begin(), from);
      if (is_no_hole(one) && is_no_hole(other)) return {one, other};
      before->second = j;
    }
    return {};
  }

  // What is thinner than the tolerance may be inside out.
  [[nodiscard]] bool is_no_hole(const Loop& loop) const
  {
    return signed_area(points_, loop) >= -tolerance_ * length_around(points_, loop);
  }

  // As many as can be had. A ring that crosses itself nowhere is all ears.
  [[nodiscard]] std::vector<Triangle> cut_ears(Loop ring) const
  {
    std::vector<Triangle> triangles;
    std::size_t i = 0;
    for (std::size_t without = 0; ring.size() >= 3 && without <= ring.size(); ++without) {
      i %= ring.size();
      const Triangle ear = corner(ring, i);
      if (ring.size() > 3 ? is_ear(ring, ear) : turn_of(ear) >= 0.0) {
        triangles.push_back(ear);
        ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(i));
        without = 0;
      }
      ++i;  // Also after an ear: a fan from one corner has thin triangles.
    }
    return triangles;
  }

  // The triangles of a ring that fold back least, and among these those of the shortest sides: of
  // each piece of the ring, from the smallest ones on, the best triangle over the side that closes
  // it (the dynamic programming of Gilbert and of Klincsek).
  [[nodiscard]] std::vector<Triangle> fill(const Loop& ring) const
  {
    const std::size_t n = ring.size();
    if (n > kMostToFill) return {};
    std::vector<double> cost(n * n, 0.0);
    std::vector<std::size_t> apex(n * n, 0);
    for (std::size_t length = 2; length < n; ++length) {
      for (std::size_t i = 0; i + length < n; ++i) {
        const std::size_t j = i + length;
        double& best = cost[i * n + j] = std::numeric_limits<double>::infinity();
        for (std::size_t k = i + 1; k < j; ++k) {
          const double sum =
              cost[i * n + k] + cost[k * n + j] + cost_of({ring[i], ring[k], ring[j]});
          if (sum >= best) continue;
          best = sum;
          apex[i * n + j] = k;
        }
      }
    }
    return filling(ring, apex);
  }

  static std::vector<Triangle> filling(const Loop& ring, const std::vector<std::size_t>& apex)
  {
    const std::size_t n = ring.size();
    std::vector<Triangle> triangles;
    std::vector<std::pair<std::size_t, std::size_t>> pieces{{0, n - 1}};
    while (!pieces.empty()) {
      const auto [i, j] = pieces.back();
      pieces.pop_back();
      if (j < i + 2) continue;
      const std::size_t k = apex[i * n + j];
      triangles.push_back({ring[i], ring[k], ring[j]});
      pieces.emplace_back(i, k);
      pieces.emplace_back(k, j);
    }
    return triangles;
  }

  [[nodiscard]] double cost_of(const Triangle& t) const
  {
    constexpr double kOfFolds = 1e6;  // Such that no notch is lost but one within rounding.
    double cost = kOfFolds * std::max(0.0, -turn_of(t));
    for (std::size_t c = 0; c < 3; ++c) {
      cost += squared_distance(point(t[c]), point(t[(c + 1) % 3]));
    }
    return cost;
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

  // The time goes with the cube of the corners: 1,500 of them take a second.
  static constexpr std::size_t kMostToFill = 1500;

  const std::vector<Point>& points_;
  const std::vector<Loop>& loops_;
  double tolerance_;
};

// Whether what folds back is no more than a boundary that is off by its tolerance makes.
bool is_sound(const PlaneMesh& mesh, const std::vector<Loop>& loops)
{
  constexpr double kMostFolded = 1e-3;  // Of the square of the length around.
  double around = 0.0;
  for (const Loop& loop : loops) around += length_around(mesh.points, loop);
  double folded = 0.0;
  for (const auto& [a, b, c] : mesh.triangles) {
    folded += std::max(0.0, -turn(mesh.points[at(a)], mesh.points[at(b)], mesh.points[at(c)]));
  }
  return folded <= kMostFolded * around * around;
}

}  // namespace

PlaneMesh triangulate_polygon(std::vector<Point> points, const std::vector<Loop>& loops,
                              double tolerance)
{
  PlaneMesh mesh;
  mesh.triangles = PolygonTriangulator(points, loops, tolerance).run();
  mesh.points = std::move(points);
  if (!is_sound(mesh, loops)) mesh.triangles.clear();
  swap_to_delaunay(mesh);
  return mesh;
}

}  // namespace tessera::geometry
