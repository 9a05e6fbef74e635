// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/model/surface_features.hpp"

#include <algorithm>
#include <map>
#include <set>

#include <gtest/gtest.h>

#include "support/stl_models.hpp"

namespace tessera::model {
namespace {

using testing::cube_soup;
using testing::sphere_soup;

// Prism over a regular polygon.
TriangleSoup prism_soup(int sides)
{
  TriangleSoup soup;
  soup.solid_names = {""};
  const auto rim = [&](int i, double z) {
    const double angle = 2.0 * std::acos(-1.0) * (i % sides) / sides;
    return Vec3{std::cos(angle), std::sin(angle), z};
  };
  const auto add = [&](const Vec3& a, const Vec3& b, const Vec3& c) {
    for (const Vec3& p : {a, b, c}) {
      soup.corner_xyz.insert(soup.corner_xyz.end(), p.begin(), p.end());
    }
    soup.triangle_solid.push_back(0);
  };
  for (int i = 0; i < sides; ++i) {
    add(rim(i, 0), rim(i + 1, 0), rim(i + 1, 1));
    add(rim(i, 0), rim(i + 1, 1), rim(i, 1));
    add(rim(i + 1, 0), rim(i, 0), {0, 0, 0});
    add(rim(i, 1), rim(i + 1, 1), {0, 0, 1});
  }
  return soup;
}

TEST(SurfaceFeatures, CubeHasSixPatchesTwelveCurvesAndEightCornerPoints)
{
  const TriangleSurface cube = check_surface(cube_soup(), "").surface;
  const SurfaceFeatures features = find_features(cube, 30.0);
  EXPECT_EQ(features.num_patches(), 6);
  EXPECT_EQ(features.num_curves(), 12);
  std::map<LocalIndex, int> patch_size;
  for (const LocalIndex p : features.triangle_patch) ++patch_size[p];
  for (const auto& [patch, size] : patch_size) EXPECT_EQ(size, 2) << patch;
  std::set<LocalIndex> ends;
  for (LocalIndex c = 0; c < features.num_curves(); ++c) {
    ASSERT_EQ(features.curve_vertices[c].size(), 2U);
    ends.insert(features.curve_vertices[c].begin(), features.curve_vertices[c].end());
  }
  EXPECT_EQ(ends.size(), 8U);
}

TEST(SurfaceFeatures, EveryFeatureEdgeIsOnOneCurveOnceAndOthersOnNone)
{
  const TriangleSurface surface = check_surface(prism_soup(20), "").surface;
  const SurfaceFeatures features = find_features(surface, 30.0);
  std::set<std::pair<LocalIndex, LocalIndex>> seen;
  for (LocalIndex c = 0; c < features.num_curves(); ++c) {
    const auto vertices = features.curve_vertices[c];
    for (std::size_t i = 1; i < vertices.size(); ++i) {
      EXPECT_EQ(features.curve_of_edge(vertices[i - 1], vertices[i]), c);
      EXPECT_TRUE(seen.insert(std::minmax({vertices[i - 1], vertices[i]})).second);
    }
  }
  EXPECT_EQ(seen.size(), features.edge_curve.size());
  EXPECT_EQ(seen.size(), 40U);
  EXPECT_EQ(features.curve_of_edge(0, 2), kNoIndex);  // diagonal of a wall
}

TEST(SurfaceFeatures, RimWithoutCornersIsAClosedLoop)
{
  const TriangleSurface surface = check_surface(prism_soup(20), "").surface;
  const SurfaceFeatures features = find_features(surface, 30.0);
  EXPECT_EQ(features.num_patches(), 3);
  ASSERT_EQ(features.num_curves(), 2);
  for (LocalIndex c = 0; c < 2; ++c) {
    EXPECT_EQ(features.curve_vertices[c].front(), features.curve_vertices[c].back());
    EXPECT_EQ(features.curve_vertices[c].size(), 21U);
  }
}

TEST(SurfaceFeatures, AngleDecidesWhatIsAFeature)
{
  const TriangleSurface surface = check_surface(prism_soup(20), "").surface;  // 18 degrees a side
  EXPECT_EQ(find_features(surface, 17.9).num_patches(), 22);
  EXPECT_EQ(find_features(surface, 18.1).num_patches(), 3);
  EXPECT_EQ(find_features(surface, 91.0).num_patches(), 1);
  EXPECT_EQ(find_features(surface, 91.0).num_curves(), 0);
}

TEST(SurfaceFeatures, SmoothSphereIsOnePatchWithoutCurves)
{
  const SurfaceFeatures features = find_features(check_surface(sphere_soup(3), "").surface, 30.0);
  EXPECT_EQ(features.num_patches(), 1);
  EXPECT_EQ(features.num_curves(), 0);
  EXPECT_EQ(features.patch_names, std::vector<std::string>{"patch_1"});
}

TEST(SurfaceFeatures, SolidsOfTheFileSeparateAndNamePatches)
{
  TriangleSoup sphere = sphere_soup(3);
  sphere.solid_names = {"north", "south"};
  std::fill(sphere.triangle_solid.begin() + sphere.num_triangles() / 2, sphere.triangle_solid.end(),
            1);
  const SurfaceFeatures halves = find_features(check_surface(sphere, "").surface, 30.0);
  EXPECT_EQ(halves.patch_names, (std::vector<std::string>{"north", "south"}));
  EXPECT_EQ(halves.num_curves(), 1);

  TriangleSoup cube = cube_soup();
  cube.solid_names = {"box"};
  const SurfaceFeatures sides = find_features(check_surface(cube, "").surface, 30.0);
  EXPECT_EQ(sides.patch_names.front(), "box_1");
  EXPECT_EQ(sides.patch_names.back(), "box_6");
}

TEST(SurfaceFeatures, TriangleWithoutAreaMakesNoFeatureInAFlatSide)
{
  // The side z = 1 of the cube, cut so that one triangle has its three corners on a line.
  TriangleSoup soup = cube_soup();
  for (int i = 0; i < 2; ++i) testing::remove_triangle(soup, 10);  // z = 1
  const auto add = [&](const Vec3& a, const Vec3& b, const Vec3& c) {
    for (const Vec3& p : {a, b, c}) {
      soup.corner_xyz.insert(soup.corner_xyz.end(), p.begin(), p.end());
    }
    soup.triangle_solid.push_back(0);
  };
  const Vec3 a{0, 0, 1};
  const Vec3 b{1, 0, 1};
  const Vec3 c{1, 1, 1};
  const Vec3 d{0, 1, 1};
  const Vec3 middle{0.5, 0.5, 1};
  add(a, b, c);
  add(a, c, middle);
  add(a, middle, d);
  add(middle, c, d);
  const TriangleSurface surface = check_surface(soup, "").surface;
  const SurfaceFeatures features = find_features(surface, 30.0);
  EXPECT_EQ(features.num_patches(), 6);
  EXPECT_EQ(features.num_curves(), 12);
  for (const Vec3& n : triangle_normals(surface)) EXPECT_NEAR(norm(n), 1.0, 1e-12);
}

}  // namespace
}  // namespace tessera::model
