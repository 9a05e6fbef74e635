// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/quality/tet_quality.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tessera/mesh/tet_topology.hpp"

namespace tessera::quality {

namespace {

double sum_of_squared_lengths(const TetCorners& corners)
{
  double sum = 0.0;
  for (const auto& [a, b] : mesh::kTetEdgeCorners) {
    const Vec3 edge = corners[b] - corners[a];
    sum += dot(edge, edge);
  }
  return sum;
}

double mean_ratio_of(double volume, const TetCorners& corners)
{
  const double squared_lengths = sum_of_squared_lengths(corners);
  if (squared_lengths == 0.0) return 0.0;
  const double cube_root = std::cbrt(3.0 * std::abs(volume));
  return std::copysign(12.0 * cube_root * cube_root / squared_lengths, volume);
}

}  // namespace

double mean_ratio(const TetCorners& corners) noexcept
{
  return mean_ratio_of(tet_volume(corners[0], corners[1], corners[2], corners[3]), corners);
}

TetShape shape_of(const TetCorners& corners) noexcept
{
  std::array<Vec3, 4> normals;
  for (std::size_t f = 0; f < 4; ++f) {
    const auto& [a, b, c] = mesh::kTetFaceCorners[f];
    normals[f] = cross(corners[b] - corners[a], corners[c] - corners[a]);
  }
  const double volume = dot(normals[3], corners[0] - corners[3]) / 6.0;  // As tet_volume().
  TetShape shape{.mean_ratio = mean_ratio_of(volume, corners)};
  for (Vec3& normal : normals) {
    const double length = norm(normal);
    if (!(length > 0.0)) return {shape.mean_ratio, 1.0, -1.0};
    normal = (1.0 / length) * normal;
  }
  for (const auto& [f, g] : mesh::kTetEdgeCorners) {
    const double cosine = -dot(normals[f], normals[g]);
    shape.largest_cosine = std::max(shape.largest_cosine, cosine);
    shape.smallest_cosine = std::min(shape.smallest_cosine, cosine);
  }
  return shape;
}

double angle_deg(double cosine) noexcept
{
  return std::acos(std::clamp(cosine, -1.0, 1.0)) * 180.0 / std::numbers::pi;
}

}  // namespace tessera::quality
