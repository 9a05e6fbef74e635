// SPDX-License-Identifier: BSD-3-Clause
// Cuts of closed surfaces leave closed surfaces, and all ways to measure them agree.
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "cut/moments.hpp"
#include "cut/part_surface.hpp"
#include "cut/profile.hpp"
#include "cut/section.hpp"
#include "cut/solid_surfaces.hpp"
#include "sample_models.hpp"

namespace tessera::cut {
namespace {

std::vector<model::ModelDescription> samples()
{
  return {testing::box(3, 2, 1), testing::l_shape(), testing::cylinder(1.0, 2.0, 24),
          testing::torus(2.0, 0.7, 16), testing::plate(3, 2, {}, 0.5)};
}

PartSurface surface_of(const model::ModelDescription& model)
{
  return solid_surfaces(model, 0.5).front().surface;
}

// Planes that meet all samples, in directions of no symmetry.
std::vector<Plane> planes_through(const PartSurface& part)
{
  std::vector<Plane> planes;
  for (const Vec3& normal : {Vec3{1.0, 0.2, 0.1}, Vec3{-0.3, 1.0, 0.4}, Vec3{0.5, -0.6, 1.0}}) {
    planes.push_back({unit(normal), balanced_offset(part, unit(normal), 0.4)});
  }
  return planes;
}

// Sum of area times normal: zero for a closed surface.
Vec3 open_area(const PartSurface& part)
{
  Vec3 sum{};
  part.for_each_triangle([&](LocalIndex a, LocalIndex b, LocalIndex c) {
    const Vec3& p = part.points[at(a)];
    sum = sum + 0.5 * cross(part.points[at(b)] - p, part.points[at(c)] - p);
  });
  return sum;
}

TEST(CutPart, KeepsVolumeAndStaysClosed)
{
  for (const model::ModelDescription& model : samples()) {
    std::vector<PartSurface> parts{surface_of(model)};
    const double volume = volume_of(parts.front());
    EXPECT_NEAR(volume, model.solids.front().volume, 1e-9);
    LocalIndex label = static_cast<LocalIndex>(model.faces.size());
    for (const Plane& plane : planes_through(parts.front())) {
      std::vector<PartSurface> finer;
      for (const PartSurface& part : parts) {
        CutSides sides = cut_part(part, plane, label++, 0.5);
        EXPECT_NEAR(volume_of(sides.below), volume_below(part, plane.normal, part.heights(plane)),
                    1e-9);
        EXPECT_NEAR(volume_of(sides.below) + volume_of(sides.above), volume_of(part), 1e-9);
        finer.push_back(std::move(sides.below));
        finer.push_back(std::move(sides.above));
      }
      parts = std::move(finer);
    }
    ASSERT_EQ(parts.size(), 8U);
    for (const PartSurface& part : parts) {
      EXPECT_LT(norm(open_area(part)), 1e-9);
      EXPECT_GE(volume_of(part), 0.0);
    }
  }
}

// Every point of a cap's border begins as many pieces as it ends.
TEST(CutPart, CapsHaveClosedBorders)
{
  for (const model::ModelDescription& model : samples()) {
    PartSurface part = surface_of(model);
    LocalIndex label = static_cast<LocalIndex>(model.faces.size());
    for (const Plane& plane : planes_through(part)) {
      part = cut_part(part, plane, label++, 0.5).above;
      for (const Cap& cap : part.caps) {
        std::vector<int> surplus(part.points.size(), 0);
        for (const auto& [a, b] : cap.border) {
          ++surplus[at(a)];
          --surplus[at(b)];
        }
        EXPECT_EQ(surplus, std::vector<int>(part.points.size(), 0));
      }
    }
    EXPECT_FALSE(part.caps.empty());
  }
}

TEST(CutPart, TheProfileAgreesWithCuts)
{
  for (const model::ModelDescription& model : samples()) {
    const PartSurface whole = surface_of(model);
    const std::vector<Plane> planes = planes_through(whole);
    const PartSurface part = cut_part(whole, planes[0], 99, 0.5).above;
    const Vec3 normal = planes[1].normal;
    const Profile profile = profile_of(part, normal, part.heights({normal, 0.0}), 20);
    for (std::size_t entry = 0; entry < profile.volume.size(); ++entry) {
      const Plane plane{normal, profile.offset(entry)};
      const std::vector<double> heights = part.heights(plane);
      EXPECT_NEAR(profile.volume[entry], volume_below(part, normal, heights), 1e-9);
      EXPECT_NEAR(profile.area[entry], section_of(part, plane, heights, 0.5).area, 1e-9);
    }
    EXPECT_GT(*std::ranges::max_element(profile.area), 0.1);
  }
}

TEST(CutPart, BalancedOffsetHasTheFractionBelow)
{
  for (const model::ModelDescription& model : samples()) {
    const PartSurface part = surface_of(model);
    const Vec3 normal = unit({0.3, 0.9, -0.2});
    for (const double fraction : {0.1, 1.0 / 3.0, 0.5, 0.9}) {
      const Plane plane{normal, balanced_offset(part, normal, fraction)};
      EXPECT_NEAR(volume_below(part, normal, part.heights(plane)), fraction * volume_of(part),
                  1e-9);
    }
  }
}

TEST(Moments, AxesOfABoxAreItsEdgesLongestFirst)
{
  const Moments moments = moments_of(surface_of(testing::box(1, 3, 2)));
  EXPECT_NEAR(moments.volume, 6.0, 1e-12);
  EXPECT_LT(norm(moments.centre - Vec3{0.5, 1.5, 1.0}), 1e-12);
  EXPECT_LT(norm(moments.axes[0] - Vec3{0, 1, 0}), 1e-9);
  EXPECT_LT(norm(moments.axes[1] - Vec3{0, 0, 1}), 1e-9);
  EXPECT_LT(norm(moments.axes[2] - Vec3{1, 0, 0}), 1e-9);
}

TEST(Moments, AxesDoNotDependOnHowTheBoxLies)
{
  const model::ModelDescription straight = testing::box(3, 2, 1);
  const std::array<Vec3, 3> turned{unit({1, 2, 2}), unit({2, 1, -2}), unit({-2, 2, -1})};
  PartSurface part = surface_of(straight);
  for (Vec3& p : part.points) p = p[0] * turned[0] + p[1] * turned[1] + p[2] * turned[2];
  const Moments moments = moments_of(part);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(std::abs(dot(moments.axes[i], turned[i])), 1.0, 1e-9);
  }
}

TEST(Section, KnowsEdgesAnglesAndArea)
{
  const PartSurface part = surface_of(testing::box(3, 2, 1));
  const Plane plane{unit({1, 1, 0}), 2.5 / std::sqrt(2.0)};
  const Section section = section_of(part, plane, part.heights(plane), 0.5);
  EXPECT_NEAR(section.area, 2.0 * std::sqrt(2.0), 1e-12);
  EXPECT_NEAR(section.perimeter, 2.0 + 4.0 * std::sqrt(2.0), 1e-12);
  EXPECT_NEAR(section.shortest_edge, 1.0, 1e-12);
  EXPECT_NEAR(section.angle_deg, 45.0, 1e-9);
}

TEST(Section, SeesTheCutsOfOtherPlanes)
{
  const PartSurface whole = surface_of(testing::box(3, 2, 1));
  const PartSurface part = cut_part(whole, {unit({1, 1, 0}), 2.5 / std::sqrt(2.0)}, 99, 0.5).below;
  const Plane plane{{0, 1, 0}, 1.0};
  const Section section = section_of(part, plane, part.heights(plane), 0.5);
  EXPECT_NEAR(section.area, 1.5, 1e-12);
  EXPECT_NEAR(section.perimeter, 5.0, 1e-12);
  EXPECT_NEAR(section.angle_deg, 45.0, 1e-9);
}

}  // namespace
}  // namespace tessera::cut
