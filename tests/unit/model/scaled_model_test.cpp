// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/model/scaled_model.hpp"

#include <gtest/gtest.h>

#include "support/bodies.hpp"
#include "support/curved_models.hpp"

namespace tessera::model {
namespace {

constexpr double kInch = 25.4;

TEST(ScaledModel, ProjectsOntoTheScaledGeometry)
{
  const testing::SphereModel sphere({1.0, 0.5});
  const ScaledModel scaled(sphere, kInch);
  const Vec3 point{3, -40, 12};
  EXPECT_NEAR(norm(scaled.project_to_surface(0, point, {}).xyz), kInch, 1e-13);
  EXPECT_NEAR(norm(scaled.project_to_surface(1, point, {}).xyz), 0.5 * kInch, 1e-13);
  EXPECT_NEAR(norm(cross(scaled.project_to_surface(0, point, {}).xyz, point)), 0.0, 1e-10);
}

TEST(ScaledModel, LeavesParametersAsTheyAre)
{
  const testing::CylinderModel cylinder;
  const ScaledModel scaled(cylinder, kInch);
  EXPECT_TRUE(scaled.has_parameters());
  const SurfacePoint exact = cylinder.project_to_surface(0, {0.8, 0.9, 0.25}, {7.0, 0.2});
  const SurfacePoint found = scaled.project_to_surface(0, kInch * Vec3{0.8, 0.9, 0.25}, {7.0, 0.2});
  EXPECT_NEAR(found.uv[0], exact.uv[0], 1e-15);
  EXPECT_NEAR(found.uv[1], exact.uv[1], 1e-15);
  const CurvePoint rim = scaled.project_to_curve(1, {kInch, kInch, 3.0}, 0.5);
  EXPECT_NEAR(rim.t, std::atan(1.0), 1e-15);
  EXPECT_EQ(rim.xyz[2], kInch);
}

TEST(ScaledModel, ScalesLengths)
{
  const testing::SphereModel sphere({2.0});
  const ScaledModel scaled(sphere, 1e-3);
  EXPECT_FALSE(scaled.has_parameters());
  EXPECT_DOUBLE_EQ(scaled.surface_tolerance(0), 1e-3 * sphere.surface_tolerance(0));
  EXPECT_DOUBLE_EQ(scaled.curve_tolerance(0), 1e-3 * sphere.curve_tolerance(0));
  EXPECT_DOUBLE_EQ(scaled.box_diagonal(), 1e-3 * sphere.box_diagonal());
}

TEST(ScaledModel, OfScaleOneChangesNoBit)
{
  const testing::SphereModel sphere({1.0});
  const ScaledModel scaled(sphere, 1.0);
  const Vec3 point{0.1, 0.7, -0.3};
  EXPECT_EQ(testing::bits(scaled.project_to_surface(0, point, {}).xyz),
            testing::bits(sphere.project_to_surface(0, point, {}).xyz));
}

}  // namespace
}  // namespace tessera::model
