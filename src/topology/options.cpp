// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/topology/options.hpp"

#include <cmath>
#include <cstddef>
#include <numbers>

namespace tessera::topology {
namespace {

// Rodrigues' formula. Quarter turns have whole numbers.
Affine rotation(const Vec3& point, const Vec3& axis, double angle_deg)
{
  const double turns = angle_deg / 90.0;
  const bool is_quarter = turns == std::round(turns);
  const double angle = angle_deg * std::numbers::pi / 180.0;
  const double cosine = is_quarter ? std::round(std::cos(angle)) : std::cos(angle);
  const double sine = is_quarter ? std::round(std::sin(angle)) : std::sin(angle);
  const Vec3 n = unit(axis);
  const std::array<Vec3, 3> across{{{0.0, -n[2], n[1]}, {n[2], 0.0, -n[0]}, {-n[1], n[0], 0.0}}};
  Affine turn;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      turn.rows[i][j] =
          (i == j ? cosine : 0.0) + (1.0 - cosine) * n[i] * n[j] + sine * across[i][j];
    }
  }
  turn.shift = point - turn.turned(point);
  return turn;
}

}  // namespace

std::string defect_of(const PeriodicSide& side)
{
  if (side.has_translation() && side.has_rotation()) {
    return "must not have both a translation and a rotation";
  }
  if (side.has_translation() && norm(side.translation) == 0.0) {
    return "has a translation of length 0; leave it out, so that it is found";
  }
  if (!side.has_rotation()) {
    const bool has_angle = side.angle_deg != PeriodicSide::kNoAngle;
    return has_angle ? "has rotation.angle without rotation.axis" : "";
  }
  if (side.axis == kNoPoint) return "has rotation.point without rotation.axis";
  if (norm(side.axis) == 0.0) return "has a rotation.axis of length 0";
  if (side.angle_deg == PeriodicSide::kNoAngle) return "has rotation.axis without rotation.angle";
  return side.angle_deg == 0.0 ? "has rotation.angle = 0; must turn by something" : "";
}

Affine transform_of(const PeriodicSide& side, const Vec3& shift)
{
  if (side.has_rotation()) {
    return rotation(side.axis_point == kNoPoint ? Vec3{} : side.axis_point, side.axis,
                    side.angle_deg);
  }
  Affine there;
  there.shift = side.has_translation() ? side.translation : shift;
  return there;
}

}  // namespace tessera::topology
