// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/model/winding.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <utility>

#include "tessera/base/triangle.hpp"

namespace tessera::model {
namespace {

constexpr LocalIndex kLeafSize = 8;
constexpr std::size_t kDeepest = 64;  // Halving 2^31 triangles gives 31 levels.

// In radii of a node. At three, a ball of 2,000 triangles with a hole has errors up to 0.011. Near
// 1/2 more digits count: that is what lies just behind a sheet that bounds nothing.
constexpr double kFar = 3.0;
constexpr double kFarNearHalf = 10.0;
constexpr double kNearHalf = 0.03;

}  // namespace

double solid_angle(const std::array<Vec3, 3>& corners, const Vec3& p)
{
  const Vec3 a = corners[0] - p;
  const Vec3 b = corners[1] - p;
  const Vec3 c = corners[2] - p;
  const double la = norm(a);
  const double lb = norm(b);
  const double lc = norm(c);
  const double denominator = la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb;
  return 2.0 * std::atan2(dot(a, cross(b, c)), denominator);
}

WindingNumbers::WindingNumbers(std::span<const Corners> triangles)
    : triangles_(triangles.begin(), triangles.end())
{
  build(0, static_cast<LocalIndex>(triangles_.size()));
}

WindingNumbers::Node WindingNumbers::node_of(LocalIndex first, LocalIndex last) const
{
  Node node{.first = first, .count = last - first};
  double area = 0.0;
  Vec3 mean{};
  for (LocalIndex t = first; t < last; ++t) {
    const Corners& corners = triangles_[tessera::at(t)];
    const Vec3 vector = 0.5 * normal_of(corners);
    // What has no area has a place all the same.
    const double weight = norm(vector) + std::numeric_limits<double>::min();
    area += weight;
    mean = mean + weight * middle_of(corners);
    node.dipole = node.dipole + vector;
  }
  node.centre = (1.0 / area) * mean;
  for (LocalIndex t = first; t < last; ++t) {
    for (const Vec3& corner : triangles_[tessera::at(t)])
      node.radius = std::max(node.radius, norm(corner - node.centre));
  }
  return node;
}

LocalIndex WindingNumbers::build(LocalIndex first, LocalIndex last)
{
  const auto number = static_cast<LocalIndex>(nodes_.size());
  nodes_.push_back(node_of(first, last));
  if (last - first <= kLeafSize) return number;
  Vec3 low = kNoPoint;
  Vec3 high = -1.0 * kNoPoint;
  for (LocalIndex t = first; t < last; ++t) {
    const Vec3 middle = middle_of(triangles_[tessera::at(t)]);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], middle[axis]);
      high[axis] = std::max(high[axis], middle[axis]);
    }
  }
  const Vec3 extent = high - low;
  const auto axis = static_cast<std::size_t>(
      std::distance(extent.begin(), std::max_element(extent.begin(), extent.end())));
  const LocalIndex half = first + (last - first) / 2;
  // By all corners behind the axis: equal middles must not leave the order to the library.
  std::nth_element(triangles_.begin() + first, triangles_.begin() + half, triangles_.begin() + last,
                   [axis](const Corners& a, const Corners& b) {
                     const double of_a = middle_of(a)[axis];
                     const double of_b = middle_of(b)[axis];
                     return of_a != of_b ? of_a < of_b : a < b;
                   });
  build(first, half);
  const LocalIndex other_child = build(half, last);
  nodes_[tessera::at(number)].other_child = other_child;
  return number;
}

double WindingNumbers::sum(const Vec3& point, double far) const
{
  std::array<LocalIndex, kDeepest> to_visit{};
  std::size_t num_to_visit = 1;
  double angle = 0.0;
  while (num_to_visit > 0) {
    const LocalIndex number = to_visit[--num_to_visit];
    const Node& node = nodes_[tessera::at(number)];
    const Vec3 offset = node.centre - point;
    const double distance2 = dot(offset, offset);
    if (distance2 > far * far * node.radius * node.radius) {
      angle += dot(node.dipole, offset) / (distance2 * std::sqrt(distance2));
    } else if (node.other_child != kNoIndex) {
      to_visit[num_to_visit++] = node.other_child;
      to_visit[num_to_visit++] = number + 1;
    } else {
      for (LocalIndex t = node.first; t < node.first + node.count; ++t)
        angle += solid_angle(triangles_[tessera::at(t)], point);
    }
  }
  return angle / (4.0 * std::numbers::pi);
}

double WindingNumbers::at(const Vec3& point) const
{
  const double number = sum(point, kFar);
  return std::abs(number - 0.5) < kNearHalf ? sum(point, kFarNearHalf) : number;
}

}  // namespace tessera::model
