// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/coarse/surface_overlap.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "tessera/coarse/remesh.hpp"

#include "support/stl_models.hpp"

namespace tessera::coarse {
namespace {

// Adds a soup as a patch, without joining corners of different triangles.
void add_patch(const model::TriangleSoup& soup, double scale, const Vec3& shift,
               PatchSurface& surface)
{
  const LocalIndex patch = surface.num_patches();
  for (std::size_t i = 0; i < soup.corner_xyz.size(); i += 9) {
    PatchSurface::Triangle v{};
    for (std::size_t c = 0; c < 3; ++c) {
      const double* x = &soup.corner_xyz[i + 3 * c];
      const Vec3 point = scale * Vec3{x[0], x[1], x[2]} + shift;
      const auto known = std::ranges::find(surface.vertex_xyz, point);
      v[c] = static_cast<LocalIndex>(known - surface.vertex_xyz.begin());
      if (known == surface.vertex_xyz.end()) surface.vertex_xyz.push_back(point);
    }
    surface.triangles.push_back(v);
    surface.triangle_patch.push_back(patch);
  }
  surface.vertex_is_fixed.assign(surface.vertex_xyz.size(), 0);
  surface.patch_materials.push_back({1, 0});
}

PatchSurface two_cubes(const Vec3& shift)
{
  PatchSurface surface;
  add_patch(testing::cube_soup(), 1.0, {}, surface);
  add_patch(testing::cube_soup(), 1.0, shift, surface);
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

TEST(SurfaceOverlap, OfAGapNarrowerThanTheTrianglesGoesWithShorterEdges)
{
  PatchSurface shells;
  add_patch(testing::sphere_soup(5), 1.0, {}, shells);
  add_patch(testing::sphere_soup(5), 0.97, {}, shells);
  const SurfaceReference reference(shells);
  CoarseOptions options;
  options.max_size = 0.8;
  options.curvature = 0.5;
  PatchSurface surface = remesh(reference, options);
  std::vector<Overlap> overlaps = find_overlaps(surface);
  ASSERT_FALSE(overlaps.empty());
  for (int round = 0; round < 3 && !overlaps.empty(); ++round) {
    std::vector<std::size_t> cut;
    for (const Overlap& overlap : overlaps) cut.push_back(overlap.first);
    surface = remesh_finer(reference, surface, cut, options);
    overlaps = find_overlaps(surface);
  }
  EXPECT_NO_THROW(validate(surface));
  EXPECT_TRUE(overlaps.empty());
}

}  // namespace
}  // namespace tessera::coarse
