// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/quality/tet_quality.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tessera/mesh/tet_topology.hpp"

namespace tessera::quality {

double mean_ratio(const TetCorners& corners) noexcept
{
  double squared_lengths = 0.0;
  for (const auto& [a, b] : mesh::kTetEdgeCorners) {
    const Vec3 edge = corners[b] - corners[a];
    squared_lengths += dot(edge, edge);
  }
  if (squared_lengths == 0.0) return 0.0;
  const double volume = tet_volume(corners[0], corners[1], corners[2], corners[3]);
  const double cube_root = std::cbrt(3.0 * std::abs(volume));
  return std::copysign(12.0 * cube_root * cube_root / squared_lengths, volume);
}

DihedralRange dihedral_range(const TetCorners& corners) noexcept
{
  std::array<Vec3, 4> normals;
  std::array<double, 4> lengths;
  for (std::size_t f = 0; f < 4; ++f) {
    const auto& [a, b, c] = mesh::kTetFaceCorners[f];
    normals[f] = cross(corners[b] - corners[a], corners[c] - corners[a]);
    lengths[f] = norm(normals[f]);
    if (!(lengths[f] > 0.0)) return {0.0, 180.0};
  }
  double largest_cosine = -1.0;
  double smallest_cosine = 1.0;
  for (const auto& [f, g] : mesh::kTetEdgeCorners) {
    const double cosine = -dot(normals[f], normals[g]) / (lengths[f] * lengths[g]);
    largest_cosine = std::max(largest_cosine, cosine);
    smallest_cosine = std::min(smallest_cosine, cosine);
  }
  const auto degrees = [](double cosine) {
    return std::acos(std::clamp(cosine, -1.0, 1.0)) * 180.0 / std::numbers::pi;
  };
  return {degrees(largest_cosine), degrees(smallest_cosine)};
}

}  // namespace tessera::quality
