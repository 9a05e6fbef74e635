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
  const auto middle = [this](LocalIndex t) { return middle_of(triangles_[tessera::at(t)]); };
  tree_ = SearchTree(
      static_cast<LocalIndex>(triangles_.size()), kLeafSize,
      [&](LocalIndex t) {
        return Box{middle(t), middle(t)};
      },
      // By all corners behind the axis: equal middles must not leave the order to the library.
      [&](LocalIndex t, std::size_t axis) {
        return std::pair<double, const Corners&>(middle(t)[axis], triangles_[tessera::at(t)]);
      },
      [this](std::span<const LocalIndex> items) { add_dipole(items); });
  for (std::size_t row = 0; row < triangles_.size(); ++row)
    triangles_[row] = triangles[tessera::at(tree_.order()[row])];
}

void WindingNumbers::add_dipole(std::span<const LocalIndex> triangles)
{
  Dipole& dipole = dipoles_.emplace_back();
  double area = 0.0;
  Vec3 mean{};
  for (const LocalIndex t : triangles) {
    const Corners& corners = triangles_[tessera::at(t)];
    const Vec3 vector = 0.5 * normal_of(corners);
    // What has no area has a place all the same.
    const double weight = norm(vector) + std::numeric_limits<double>::min();
    area += weight;
    mean = mean + weight * middle_of(corners);
    dipole.sum = dipole.sum + vector;
  }
  dipole.centre = (1.0 / area) * mean;
  for (const LocalIndex t : triangles) {
    for (const Vec3& corner : triangles_[tessera::at(t)])
      dipole.radius = std::max(dipole.radius, norm(corner - dipole.centre));
  }
}

double WindingNumbers::sum(const Vec3& point, double far) const
{
  std::array<LocalIndex, kDeepest> to_visit{};
  std::size_t num_to_visit = 1;
  double angle = 0.0;
  while (num_to_visit > 0) {
    const LocalIndex number = to_visit[--num_to_visit];
    const SearchTree::Node& node = tree_.nodes()[tessera::at(number)];
    const Dipole& dipole = dipoles_[tessera::at(number)];
    const Vec3 offset = dipole.centre - point;
    const double distance2 = dot(offset, offset);
    if (distance2 > far * far * dipole.radius * dipole.radius) {
      angle += dot(dipole.sum, offset) / (distance2 * std::sqrt(distance2));
    } else if (!node.is_leaf()) {
      to_visit[num_to_visit++] = node.other_child;
      to_visit[num_to_visit++] = number + 1;
    } else {
      for (LocalIndex t = node.first; t < node.last; ++t)
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
