// SPDX-License-Identifier: BSD-3-Clause
#include "cut/directions.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace tessera::cut {
namespace {

constexpr double kSame = 0.9994;         // Cosine of 2 degrees: nearer ones are the same.
constexpr double kFlat = 0.9998;         // Sum of area times normal, over the area.
constexpr double kRound = 1e-3;          // Share of the normals' spread that is along the axis.
constexpr std::size_t kMostOfAKind = 4;  // Flat faces' normals, round faces' axes.

class Directions {
 public:
  void add(const Vec3& direction)
  {
    const double length = norm(direction);
    if (!(length > 0.0)) return;
    const Vec3 unit = turned_forward((1.0 / length) * direction);
    for (const Direction& known : found_) {
      if (std::abs(dot(known.normal, unit)) > kSame) return;
    }
    found_.push_back({unit, are_plain_});
  }

  void end_plain() { are_plain_ = false; }

  std::vector<Direction> take() { return std::move(found_); }

 private:
  std::vector<Direction> found_{};
  bool are_plain_ = true;
};

struct FaceShape {
  double area = 0.0;
  Vec3 normal{};       // Sum of area times normal.
  Symmetric spread{};  // Sum of area times the normal's square.
};

std::map<LocalIndex, FaceShape> shapes_of_faces(const PartSurface& part)
{
  std::map<LocalIndex, FaceShape> shapes;
  for (const SurfaceTriangle& triangle : part.triangles) {
    const auto& [a, b, c] = triangle.vertices;
    const Vec3 origin = part.points[at(a)];
    const Vec3 normal = 0.5 * cross(part.points[at(b)] - origin, part.points[at(c)] - origin);
    const double area = norm(normal);
    if (!(area > 0.0)) continue;
    FaceShape& shape = shapes[triangle.face];
    shape.area += area;
    shape.normal = shape.normal + normal;
    std::size_t row = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = i; j < 3; ++j) shape.spread[row++] += normal[i] * normal[j] / area;
    }
  }
  return shapes;
}

struct Weighted {
  Vec3 direction{};
  double area = 0.0;
};

// Sums up the same directions of several faces.
void gather(std::vector<Weighted>& list, const Vec3& direction, double area)
{
  for (Weighted& known : list) {
    if (std::abs(dot(known.direction, direction)) > kSame) {
      known.area += area;
      return;
    }
  }
  list.push_back({direction, area});
}

void add_largest(std::vector<Weighted> list, Directions& to)
{
  std::ranges::stable_sort(list, std::ranges::greater{}, &Weighted::area);
  for (std::size_t i = 0; i < std::min(list.size(), kMostOfAKind); ++i) to.add(list[i].direction);
}

void add_of_faces(const PartSurface& part, Directions& to)
{
  std::vector<Weighted> flat;
  std::vector<Weighted> round;
  for (const auto& [face, shape] : shapes_of_faces(part)) {
    if (norm(shape.normal) > kFlat * shape.area) {
      gather(flat, turned_forward((1.0 / norm(shape.normal)) * shape.normal), shape.area);
      continue;
    }
    const Eigen eigen = eigen_of(shape.spread);
    if (eigen.values[2] < kRound * shape.area) gather(round, eigen.axes[2], shape.area);
  }
  add_largest(std::move(flat), to);
  add_largest(std::move(round), to);
}

}  // namespace

std::vector<Direction> candidate_directions(const PartSurface& part, const Moments& moments)
{
  Directions directions;
  // Exact ones first, in place of axes of inertia that are off by rounding: planes that are nearly
  // parallel to a face, or across an axis, cost NETGEN minutes.
  for (const Vec3& axis : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}) directions.add(axis);
  add_of_faces(part, directions);
  directions.end_plain();
  for (const Vec3& axis : moments.axes) directions.add(axis);
  const auto& [u, v, w] = moments.axes;
  for (const Vec3& sum : {u + v, u - v, u + w, u - w, v + w, v - w}) directions.add(sum);
  for (const double y : {1.0, -1.0}) {
    for (const double z : {1.0, -1.0}) directions.add(u + y * v + z * w);
  }
  for (const double y : {2.0, -2.0, 0.5, -0.5}) {
    for (const auto& [a, b] : {std::pair(u, v), std::pair(u, w), std::pair(v, w)}) {
      directions.add(a + y * b);
    }
  }
  return directions.take();
}

}  // namespace tessera::cut
