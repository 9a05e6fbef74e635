// SPDX-License-Identifier: BSD-3-Clause
#include "netgen/csg/planes.hpp"

#include <cmath>

#include "tessera/base/vec3.hpp"

#include "netgen/csg/access.hpp"
#include "netgen/versions.hpp"

namespace tessera::netgen {
namespace {

using ::netgen::Plane;

constexpr int kMostMoves = 40;
// In tolerances, and how much farther each move goes. With the angle no two go the same way.
constexpr double kFirstMove = 100.0;
constexpr double kGrowth = 1.5;
constexpr double kGoldenAngle = 2.399963229728653;

// Two planes that are one are to stay one.
bool is_on_other(const ::netgen::CSGeometry& geometry, const ::netgen::Point<3>& point,
                 double tolerance)
{
  for (int s = 0; s < geometry.GetNSurf(); ++s) {
    const ::netgen::Surface& other = *geometry.GetSurface(s);
    if (as_plane(&other) != nullptr) continue;
    if (std::abs(other.CalcFunctionValue(point)) <= tolerance) return true;
  }
  return false;
}

void describe_by(const Vec3& point, Plane& plane)
{
  NetgenArray<double> numbers;
  for (const double x : point) numbers.Append(x);
  for (int axis = 0; axis < 3; ++axis) numbers.Append(plane.N()(axis));
  plane.SetPrimitiveData(numbers);
}

}  // namespace

void separate_planes(::netgen::CSGeometry& geometry, double tolerance)
{
  for (int s = 0; s < geometry.GetNSurf(); ++s) {
    auto* const plane = const_cast<Plane*>(as_plane(geometry.GetSurface(s)));
    if (plane == nullptr) continue;
    const Vec3 start = from_netgen(plane->P());
    const ::netgen::Vec<3> along = plane->N().GetNormal();
    const Vec3 u = unit({along(0), along(1), along(2)});
    const Vec3 v = unit(cross({plane->N()(0), plane->N()(1), plane->N()(2)}, u));
    double distance = kFirstMove * tolerance;
    for (int i = 0; i < kMostMoves && is_on_other(geometry, plane->P(), tolerance); ++i) {
      const double angle = kGoldenAngle * i;
      describe_by(start + distance * std::cos(angle) * u + distance * std::sin(angle) * v, *plane);
      distance *= kGrowth;
    }
  }
}

}  // namespace tessera::netgen
