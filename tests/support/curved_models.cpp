// SPDX-License-Identifier: BSD-3-Clause
#include "support/curved_models.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tessera/base/error.hpp"

namespace tessera::testing {
namespace {

// The angle of a point in the branch next to the guess.
double angle_near(const Vec3& point, double guess)
{
  constexpr double kTurn = 2.0 * std::numbers::pi;
  const double angle = std::atan2(point[1], point[0]);
  const double found = angle + kTurn * std::round((guess - angle) / kTurn);
  if (std::abs(found - guess) > 0.25 * kTurn) {
    throw GeometryError("the guess of an angle is more than a quarter turn off");
  }
  return found;
}

Vec3 on_mantle(const Vec3& point)
{
  const double radius = std::hypot(point[0], point[1]);
  return {point[0] / radius, point[1] / radius, point[2]};
}

}  // namespace

model::SurfacePoint SphereModel::project_to_surface(LocalIndex surface, const Vec3& point,
                                                    const model::SurfaceParameters&) const
{
  return {(radii_.at(static_cast<std::size_t>(surface)) / norm(point)) * point, {}};
}

model::CurvePoint SphereModel::project_to_curve(LocalIndex, const Vec3&, double) const
{
  throw GeometryError("a sphere has no curves");
}

double SphereModel::box_diagonal() const
{
  return 2.0 * std::sqrt(3.0) * *std::max_element(radii_.begin(), radii_.end());
}

model::SurfacePoint CylinderModel::project_to_surface(LocalIndex surface, const Vec3& point,
                                                      const model::SurfaceParameters& guess) const
{
  if (surface != 0) return {{point[0], point[1], surface == 1 ? 0.0 : 1.0}, {point[0], point[1]}};
  return {on_mantle(point), {angle_near(point, guess[0]), point[2]}};
}

model::CurvePoint CylinderModel::project_to_curve(LocalIndex curve, const Vec3& point,
                                                  double guess) const
{
  const Vec3 on_curve = on_mantle({point[0], point[1], curve == 0 ? 0.0 : 1.0});
  return {on_curve, angle_near(point, guess)};
}

double CylinderModel::box_diagonal() const { return 3.0; }

model::SurfacePoint GraphModel::project_to_surface(LocalIndex surface, const Vec3& point,
                                                   const model::SurfaceParameters&) const
{
  if (surface != 4) return {point, {}};
  return {{point[0], point[1], height_(point[0], point[1])}, {}};
}

model::CurvePoint GraphModel::project_to_curve(LocalIndex, const Vec3& point, double) const
{
  return {point, 0.0};
}

double GraphModel::box_diagonal() const { return std::sqrt(3.0); }

model::SurfacePoint LazyModel::project_to_surface(LocalIndex surface, const Vec3& point,
                                                  const model::SurfaceParameters& guess) const
{
  const model::SurfacePoint exact = exact_.project_to_surface(surface, point, guess);
  return {point + share_ * (exact.xyz - point), exact.uv};
}

model::CurvePoint LazyModel::project_to_curve(LocalIndex curve, const Vec3& point,
                                              double guess) const
{
  const model::CurvePoint exact = exact_.project_to_curve(curve, point, guess);
  return {point + share_ * (exact.xyz - point), exact.t};
}

}  // namespace tessera::testing
