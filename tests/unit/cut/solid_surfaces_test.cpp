// SPDX-License-Identifier: BSD-3-Clause
// Which triangles bound a solid, and where its faces meet.
#include "cut/solid_surfaces.hpp"

#include <algorithm>
#include <span>

#include <gtest/gtest.h>

#include "cut/moments.hpp"
#include "sample_models.hpp"

namespace tessera::cut {
namespace {

TEST(SolidSurfaces, FacesInOnePlaneAreSharedOut)
{
  const auto solids = solid_surfaces(testing::two_cubes(), 0.5);
  ASSERT_EQ(solids.size(), 2U);
  for (const SolidSurface& solid : solids) {
    EXPECT_EQ(solid.unfit_because, "");
    EXPECT_NEAR(volume_of(solid.surface), 1.0, 1e-12);
    EXPECT_EQ(solid.surface.triangles.size(), 12U);
    EXPECT_EQ(solid.surface.edges.size(), 12U);
  }
}

TEST(SolidSurfaces, FeatureEdgesAreWhereFacesMeet)
{
  const auto solids = solid_surfaces(testing::cylinder(1.0, 2.0, 24), 0.5);
  EXPECT_EQ(solids.front().surface.edges.size(), 48U);
  EXPECT_EQ(solids.front().surface.points.size(), 50U);
  const auto round = solid_surfaces(testing::torus(2.0, 0.5, 8), 0.5);
  EXPECT_TRUE(round.front().surface.edges.empty());
}

TEST(SolidSurfaces, ASeamOfAFaceIsAnEdge)
{
  model::ModelDescription model = testing::cylinder(1.0, 2.0, 24);
  // The round face gets points of its own where it ends, as if it were rolled up.
  const auto first = std::ranges::find(model.triangle_face, 2) - model.triangle_face.begin();
  for (const auto corner : {3 * first, 3 * first + 3, 3 * first + 5}) {
    LocalIndex& v = model.triangle_vertices[static_cast<std::size_t>(corner)];
    const Vec3 p = point_at(std::span(model.vertex_xyz), v);
    v = static_cast<LocalIndex>(model.vertex_xyz.size() / 3);
    model.vertex_xyz.insert(model.vertex_xyz.end(), p.begin(), p.end());
  }
  EXPECT_GT(solid_surfaces(model, 0.5).front().surface.edges.size(), 48U);
}

TEST(SolidSurfaces, SmallCurvesHaveSmallSizes)
{
  const auto solids = solid_surfaces(testing::plate(1, 1, {.radius = 0.06}, 1.0), 0.5);
  double smallest = 1.0;
  double largest = 0.0;
  for (const FeatureEdge& edge : solids.front().surface.edges) {
    smallest = std::min(smallest, edge.size);
    largest = std::max(largest, edge.size);
  }
  EXPECT_NEAR(smallest, 0.12, 0.01);
  EXPECT_NEAR(largest, 0.5, 1e-9);
}

TEST(SolidSurfaces, AMissingFaceMakesASolidUnfit)
{
  model::ModelDescription model = testing::box(1, 1, 1);
  model.triangle_face.resize(10);
  model.triangle_vertices.resize(30);
  EXPECT_EQ(solid_surfaces(model, 0.5).front().unfit_because, "its triangles do not close");
}

TEST(SolidSurfaces, TrianglesThatAreFarFromTheSolidMakeItUnfit)
{
  model::ModelDescription model = testing::box(1, 1, 1);
  model.solids.front().volume = 1.2;
  EXPECT_EQ(solid_surfaces(model, 0.5).front().unfit_because, "its triangles enclose 1, not 1.2");
}

}  // namespace
}  // namespace tessera::cut
