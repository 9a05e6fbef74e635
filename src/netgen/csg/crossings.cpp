// SPDX-License-Identifier: BSD-3-Clause
#include "netgen/csg/crossings.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>
#include <vector>

#include "netgen/csg/access.hpp"
#include "netgen/csg/tree.hpp"
#include "netgen/versions.hpp"

namespace tessera::netgen {
namespace {

using Geometry = ::netgen::CSGeometry;
using ::netgen::Plane;
using Point = ::netgen::Point<3>;
using Vector = ::netgen::Vec<3>;

// What two planes have in common, cut off at a box.
struct Line {
  Point start{};
  Vector direction{};  // Of length 1.
  double length = 0.0;
};

// Nothing if the planes are nearly parallel.
bool find_line(const Geometry& geometry, int first, int second, const ::netgen::Box<3>& box,
               Line& line)
{
  constexpr double kParallel = 1e-6;
  const Plane& a = *as_plane(geometry.GetSurface(first));
  const Plane& b = *as_plane(geometry.GetSurface(second));
  const Vector direction = Cross(a.N(), b.N());
  const double sine = direction.Length() / (a.N().Length() * b.N().Length());
  if (sine < kParallel) return false;
  line.direction = (1.0 / direction.Length()) * direction;
  Point middle = box.Center();
  project_to_edge(geometry, first, second, middle);
  line.length = 2.0 * box.Diam();
  line.start = middle - (0.5 * line.length) * line.direction;
  return true;
}

// Where a line goes through a surface: found between samples, by bisection.
std::vector<Point> points_on(const ::netgen::Surface& surface, const Line& line)
{
  constexpr int kSamples = 400;
  constexpr int kHalvings = 60;
  const auto point = [&](double s) { return line.start + (s * line.length) * line.direction; };
  const auto value = [&](double s) { return surface.CalcFunctionValue(point(s)); };
  std::vector<Point> found;
  double before = value(0.0);
  for (int i = 1; i <= kSamples; ++i) {
    double low = 1.0 * (i - 1) / kSamples;
    double high = 1.0 * i / kSamples;
    const double here = value(high);
    const bool changes = (before < 0.0) != (here < 0.0);
    const bool starts_negative = before < 0.0;
    before = here;
    if (!changes) continue;
    for (int h = 0; h < kHalvings; ++h) {
      const double middle = 0.5 * (low + high);
      ((value(middle) < 0.0) == starts_negative ? low : high) = middle;
    }
    found.push_back(point(0.5 * (low + high)));
  }
  return found;
}

// Surfaces with one number for those that are the same.
using Surfaces = std::set<int>;

class Crossings {
 public:
  Crossings(Geometry& geometry, const CutObjects& objects, const ::netgen::Box<3>& box)
      : geometry_(geometry), objects_(objects), box_(box)
  {
    for (std::size_t i = 0; i < objects.solid.size(); ++i) {
      const auto solid = at(objects.solid[i]);
      if (objects.part[i] == kNoIndex) continue;
      surfaces_.resize(std::max(surfaces_.size(), solid + 1));
      parts_.resize(surfaces_.size());
      const Surfaces of_part =
          surfaces_of(geometry, *geometry.GetTopLevelObject(static_cast<int>(i))->GetSolid());
      surfaces_[solid].insert(of_part.begin(), of_part.end());
      parts_[solid].push_back(static_cast<int>(i));
    }
  }

  void run()
  {
    for (std::size_t a = 0; a < surfaces_.size(); ++a) {
      for (std::size_t b = 0; b < surfaces_.size(); ++b) {
        if (a != b) find_between(a, b);
      }
    }
  }

 private:
  [[nodiscard]] bool is_plane(int surface) const
  {
    return as_plane(geometry_.GetSurface(surface)) != nullptr;
  }

  // Of cuts of `a` with surfaces of `b`, on what both have.
  void find_between(std::size_t a, std::size_t b)
  {
    for (const int shared : surfaces_[a]) {
      if (!surfaces_[b].contains(shared)) continue;
      for (const int cut : surfaces_[a]) {
        if (cut < objects_.num_surfaces || cut == shared) continue;
        for (const int other : surfaces_[b]) {
          const bool is_found_below = other >= objects_.num_surfaces && b < a;
          if (other == shared || other == cut || is_found_below) continue;
          find_on({a, cut}, {b, other}, shared);
        }
      }
    }
  }

  struct Side {
    std::size_t solid;
    int surface;
  };

  // A line of two planes, and the third surface. Two curved surfaces are left to NETGEN.
  void find_on(const Side& first, const Side& second, int shared)
  {
    const bool is_other_flat = is_plane(second.surface);
    // NETGEN sees that two straight edges cross.
    if (is_plane(shared) == is_other_flat) return;
    const int flat = is_other_flat ? second.surface : shared;
    Line line;
    if (!find_line(geometry_, first.surface, flat, box_, line)) return;
    const ::netgen::Surface& third = *geometry_.GetSurface(is_other_flat ? shared : second.surface);
    for (const Point& point : points_on(third, line)) {
      if (has_edge(first, shared, point) && has_edge(second, shared, point)) add(point);
    }
  }

  // Whether two surfaces of a part of that solid meet at a point.
  [[nodiscard]] bool has_edge(const Side& side, int shared, const Point& point) const
  {
    return std::ranges::any_of(parts_[side.solid], [&](int object) {
      const Surfaces here =
          surfaces_at(point, geometry_, *geometry_.GetTopLevelObject(object)->GetSolid(),
                      geometry_.GetIdEps() * geometry_.MaxSize());
      return here.contains(side.surface) && here.contains(shared);
    });
  }

  void add(const Point& point)
  {
    const double near = 1e-8 * geometry_.MaxSize();
    for (int i = 0; i < geometry_.GetNUserPoints(); ++i) {
      if (Dist(geometry_.GetUserPoint(i), point) < near) return;
    }
    geometry_.AddUserPoint(point);
  }

  Geometry& geometry_;
  const CutObjects& objects_;
  const ::netgen::Box<3>& box_;
  std::vector<Surfaces> surfaces_{};       // By solid.
  std::vector<std::vector<int>> parts_{};  // By solid: its top-level objects.
};

}  // namespace

void add_crossings(Geometry& geometry, const CutObjects& objects, const ::netgen::Box<3>& box)
{
  Crossings(geometry, objects, box).run();
}

}  // namespace tessera::netgen
