// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/coarse/gregory_patch.hpp"

namespace tessera::coarse {
namespace {

// Two directions in the tangent plane at a side.
struct Frame {
  Vec3 along{};
  Vec3 across{};  // Of length 1, at right angles to `along`.

  [[nodiscard]] std::array<double, 2> weights_of(const Vec3& v) const
  {
    return {dot(v, along) / dot(along, along), dot(v, across)};
  }
  [[nodiscard]] Vec3 combined(const std::array<double, 2>& weights) const
  {
    return weights[0] * along + weights[1] * across;
  }
};

}  // namespace

GregoryPatch::GregoryPatch(const Corners& corners, const Sides& sides, const Corners& normals)
    : corners_(corners), sides_(sides)
{
  for (std::size_t side = 0; side < 3; ++side) inner_[side] = beside(side, normals);
}

// The row of control points next to a side is the side's, raised to degree four, and a step off it.
// The step is a linear combination of the side's tangent and of the direction across it, with
// weights that change linearly from one corner to the other, where they are known.
std::array<Vec3, 2> GregoryPatch::beside(std::size_t side, const Corners& normals) const
{
  const std::size_t next = (side + 1) % 3;
  const std::size_t last = (side + 2) % 3;
  const Vec3& p0 = corners_[side];
  const Vec3& p3 = corners_[next];
  const auto& [p1, p2] = sides_[side];
  const Vec3 q1 = 0.25 * p0 + 0.75 * p1;
  const Vec3 q2 = midpoint(p1, p2);
  const Vec3 q3 = 0.75 * p2 + 0.25 * p3;
  const Vec3 first = 0.25 * p0 + 0.75 * sides_[last][1];
  const Vec3 end = 0.25 * p3 + 0.75 * sides_[next][0];

  Frame begin{p1 - p0, unit(cross(normals[side], p1 - p0))};
  Frame finish{p3 - p2, unit(cross(normals[next], p3 - p2))};
  const Frame middle{p2 - p1, unit(begin.across + finish.across)};
  const auto of_begin = begin.weights_of(first - midpoint(p0, q1));
  const auto of_finish = finish.weights_of(end - midpoint(q3, p3));
  return {midpoint(q1, q2) + (2.0 / 3.0) * middle.combined(of_begin)
              + (1.0 / 3.0) * begin.combined(of_finish),
          midpoint(q2, q3) + (1.0 / 3.0) * finish.combined(of_begin)
              + (2.0 / 3.0) * middle.combined(of_finish)};
}

Vec3 GregoryPatch::at(const std::array<double, 3>& weights) const
{
  Vec3 point{};
  const double all = weights[0] * weights[1] * weights[2];
  for (std::size_t c = 0; c < 3; ++c) {
    const std::size_t next = (c + 1) % 3;
    const std::size_t last = (c + 2) % 3;
    const double a = weights[c];
    const double b = weights[next];
    const double other = weights[last];
    const auto& [p1, p2] = sides_[c];
    point = point + (a * a * a * a) * corners_[c] + (a * a * a * b) * (corners_[c] + 3.0 * p1)
            + (3.0 * a * a * b * b) * (p1 + p2) + (a * b * b * b) * (3.0 * p2 + corners_[next]);
    if (b + other > 0.0) {
      point = point + (12.0 * a * all / (b + other)) * (b * inner_[c][0] + other * inner_[last][1]);
    }
  }
  return point;
}

}  // namespace tessera::coarse
