// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/surface/overlap.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "support/patch_surfaces.hpp"
#include "support/stl_models.hpp"

namespace tessera::surface {
namespace {

PatchSurface two_cubes(const Vec3& shift)
{
  PatchSurface surface;
  testing::add_patch(testing::cube_soup(), 1.0, {}, surface);
  testing::add_patch(testing::cube_soup(), 1.0, shift, surface);
  return surface;
}

TEST(SurfaceOverlap, ThereIsNoneInABodyNorBetweenBodiesThatAreApart)
{
  EXPECT_TRUE(find_overlaps(two_cubes({1.5, 0.0, 0.0})).empty());
  EXPECT_TRUE(find_overlaps(two_cubes({1.0, 1.0, 1.0})).empty()) << "they touch at a corner";
}

TEST(SurfaceOverlap, IsFoundWithItsPlaceWhereBodiesCutEachOther)
{
  const PatchSurface surface = two_cubes({0.6, 0.7, 0.8});
  const auto overlaps = find_overlaps(surface);
  ASSERT_FALSE(overlaps.empty());
  for (const auto& [first, second, place] : overlaps) {
    EXPECT_EQ(surface.triangle_patch[first], 0);
    EXPECT_EQ(surface.triangle_patch[second], 1);
    for (std::size_t d = 0; d < 3; ++d) {
      EXPECT_GE(place[d], 0.6 + 0.1 * static_cast<double>(d) - 1e-12);
      EXPECT_LE(place[d], 1.0 + 1e-12);
    }
  }
}

// Two triangles whose planes are upright to each other; a corner of the second one.
PatchSurface upright_triangles(const Vec3& corner)
{
  PatchSurface surface;
  surface.vertex_xyz = {{0, 0, 0}, {1, 0, 0},           {0.5, -1, 0},
                        corner,    {0.5, corner[1], 1}, {0.5, corner[1] + 1, 1}};
  surface.vertex_is_fixed.assign(6, 0);
  surface.triangles = {{0, 1, 2}, {3, 4, 5}};
  surface.triangle_patch = {0, 0};
  surface.patch_materials = {{1, 0}};
  return surface;
}

TEST(SurfaceOverlap, IsFoundWhereTwoEdgesMeetAndNotWhereACornerTouchesATriangle)
{
  EXPECT_EQ(find_overlaps(upright_triangles({0.5, 0, -1})).size(), 1U) << "edges meet";
  EXPECT_EQ(find_overlaps(upright_triangles({0.5, 0, 0})).size(), 1U) << "a corner is in an edge";
  EXPECT_TRUE(find_overlaps(upright_triangles({0.5, -0.3, 0})).empty());
}

TEST(SurfaceOverlap, OfTwoBodiesIsNoneWithinOne)
{
  PatchSurface surface = two_cubes({0.6, 0.7, 0.8});
  surface.patch_materials = {{1, 0}, {2, 0}};
  const auto overlaps = find_overlaps(surface);
  EXPECT_TRUE(forbidden_overlaps(surface, Forbidden::cuts_within_bodies).empty());
  surface.patch_materials = {{1, 0}, {2, 1}};
  EXPECT_EQ(forbidden_overlaps(surface, Forbidden::cuts_within_bodies).size(), overlaps.size());
}

}  // namespace
}  // namespace tessera::surface
