// SPDX-License-Identifier: BSD-3-Clause
#include "sizing/solids.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include "tessera/base/tet.hpp"
#include "tessera/mesh/tet_edges.hpp"
#include "tessera/model/nearest_point.hpp"

namespace tessera::sizing {
namespace {

constexpr double kNearEnough = 0.2;  // In longest edges of a tet.

// Going to the nearest point of the one and of the other in turn ends at the nearest points of two
// convex bodies.
template <class Solid>
bool is_near(const Solid& solid, const std::array<Vec3, 4>& tet)
{
  constexpr int kMostTurns = 50;
  constexpr double kLeastGain = 1e-3;
  const double longest = mesh::longest_edge(tet);
  Vec3 in_tet = midpoint(midpoint(tet[0], tet[1]), midpoint(tet[2], tet[3]));
  double distance = std::numeric_limits<double>::infinity();
  for (int turn = 0; turn < kMostTurns; ++turn) {
    const Vec3 in_solid = nearest_point(solid, in_tet);
    if (turn == 0 && norm(in_solid - in_tet) > (1.0 + kNearEnough) * longest) return false;
    in_tet = model::nearest_point_of(tet, in_solid);
    const double before = distance;
    distance = norm(in_solid - in_tet);
    if (distance <= kNearEnough * longest) return true;
    if (distance > (1.0 - kLeastGain) * before) return false;
  }
  return false;
}

}  // namespace

Vec3 nearest_point(const Box& box, const Vec3& point) noexcept
{
  Vec3 nearest{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    nearest[axis] = std::clamp(point[axis], box.min[axis], box.max[axis]);
  }
  return nearest;
}

Vec3 nearest_point(const Ball& ball, const Vec3& point) noexcept
{
  const Vec3 offset = point - ball.centre;
  const double distance = norm(offset);
  return distance <= ball.radius ? point : ball.centre + (ball.radius / distance) * offset;
}

Vec3 nearest_point(const Cylinder& cylinder, const Vec3& point) noexcept
{
  const Vec3 axis = cylinder.end - cylinder.start;
  const double along = dot(point - cylinder.start, axis) / dot(axis, axis);
  const Vec3 offset = point - cylinder.start - along * axis;  // From the axis.
  const double distance = norm(offset);
  const bool is_between = along >= 0.0 && along <= 1.0;
  if (is_between && distance <= cylinder.radius) return point;
  const double inwards = distance > cylinder.radius ? cylinder.radius / distance : 1.0;
  return cylinder.start + std::clamp(along, 0.0, 1.0) * axis + inwards * offset;
}

Vec3 nearest_point(const HalfSpace& half_space, const Vec3& point) noexcept
{
  const double above = dot(point - half_space.point, half_space.normal);
  if (above <= 0.0) return point;
  return point - (above / dot(half_space.normal, half_space.normal)) * half_space.normal;
}

template <class Solid>
bool meets(const Solid& solid, const mesh::CoarseMesh& coarse)
{
  for (LocalIndex t = 0; t < coarse.num_tets(); ++t) {
    if (is_near(solid, corners_at<4>(coarse.vertex_xyz, coarse.tet_vertices, t))) return true;
  }
  return false;
}

template bool meets(const Box&, const mesh::CoarseMesh&);
template bool meets(const Ball&, const mesh::CoarseMesh&);
template bool meets(const Cylinder&, const mesh::CoarseMesh&);
template bool meets(const HalfSpace&, const mesh::CoarseMesh&);

}  // namespace tessera::sizing
