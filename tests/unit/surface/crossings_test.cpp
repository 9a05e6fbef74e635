// SPDX-License-Identifier: BSD-3-Clause
#include "surface/crossings.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "tessera/surface/on_geometry.hpp"
#include "tessera/surface/overlap.hpp"

#include "support/curved_models.hpp"
#include "support/patch_surfaces.hpp"
#include "support/stl_models.hpp"

#include "surface/remesh/remesh.hpp"

namespace tessera::surface {
namespace {

using testing::add_patch;
using testing::cube_soup;
using testing::sphere_soup;

// Boxes here and there, the same at every run.
Box some_box(int i)
{
  const auto place = [i](double step) { return std::fmod(step * i, 1.0); };
  const Vec3 low{place(0.618), place(0.414), place(0.732)};
  const double side = i % 10 == 0 ? 0.4 : 0.02;
  return {low, low + Vec3{side, side, side}};
}

std::vector<LocalIndex> touching(const BoxTree& tree, const Box& box)
{
  std::vector<LocalIndex> found;
  tree.visit([&](const Box& other) { return other.touches(box); },
             [&](LocalIndex item) { found.push_back(item); });
  std::ranges::sort(found);
  return found;
}

TEST(BoxTree, FindsAllThatTouchWhateverChanged)
{
  std::vector<Box> boxes;
  for (int i = 0; i < 200; ++i) boxes.push_back(some_box(i));
  BoxTree tree(boxes);
  std::size_t num_found = 0;
  for (int step = 0; step < 1000; ++step) {
    const Box box = some_box(200 + step);
    const auto item = static_cast<std::size_t>(step * 7) % boxes.size();
    if (step % 3 == 0) {
      boxes.push_back(box);
      tree.add(box, static_cast<LocalIndex>(item));
    } else {
      boxes[item] = step % 3 == 1 ? box : Box{};
      tree.change(static_cast<LocalIndex>(item), boxes[item]);
    }
    std::vector<LocalIndex> expected;
    const Box asked = some_box(step);
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      if (boxes[i].touches(asked)) expected.push_back(static_cast<LocalIndex>(i));
    }
    ASSERT_EQ(touching(tree, asked), expected) << "step " << step;
    num_found += expected.size();
  }
  EXPECT_GT(num_found, 1000U);
}

TEST(BoxTree, FindsAllThatCameToOnePlace)
{
  std::vector<Box> boxes;
  for (int i = 0; i < 2000; ++i) boxes.push_back(some_box(i));
  BoxTree tree(boxes);
  for (int i = 2000; i < 4000; ++i) {
    const double side = std::pow(0.9, i - 2000);
    boxes.push_back({{}, {side, side, side}});
    tree.add(boxes.back(), i == 2000 ? 0 : i - 1);
  }
  EXPECT_GE(touching(tree, {{}, {}}).size(), 2000U);
}

// Two triangles beside each other; the second one is shifted upwards.
PatchSurface two_triangles(double height)
{
  PatchSurface surface;
  surface.vertex_xyz = {{0, 0, 0},      {1, 0, 0},      {0, 1, 0},
                        {0, 0, height}, {1, 0, height}, {0, 1, height}};
  surface.vertex_is_fixed.assign(6, 0);
  surface.triangles = {{0, 1, 2}, {3, 4, 5}};
  surface.triangle_patch = {0, 0};
  surface.patch_materials = {{1, 0}};
  return surface;
}

// The second triangle with a corner at another height.
PlacedTriangle bent(double height)
{
  return {{3, 4, 5}, {Vec3{0.2, 0.2, height}, Vec3{1, 0, 0.1}, Vec3{0, 1, 0.1}}};
}

TEST(CrossingGuard, AllowsWhatCutsNoMoreThanBefore)
{
  CrossingGuard guard(two_triangles(0.1));
  const std::vector<LocalIndex> second{1};
  EXPECT_TRUE(guard.allows(second, std::vector{bent(0.01)}));
  EXPECT_FALSE(guard.allows(second, std::vector{bent(-0.01)}));
  guard.change(1, bent(-0.01));
  EXPECT_TRUE(guard.allows(second, std::vector{bent(-0.02)})) << "it cut the first one already";
  guard.remove(0);
  guard.change(1, bent(0.01));
  EXPECT_TRUE(guard.allows(second, std::vector{bent(-0.01)})) << "nothing is left that it cuts";
}

TEST(CrossingGuard, SeesWhatWasAdded)
{
  CrossingGuard guard(two_triangles(1.0));
  const std::vector<LocalIndex> first{0};
  const PlacedTriangle up{{0, 1, 2}, {Vec3{0.2, 0.2, 0.3}, Vec3{1, 0, 0}, Vec3{0, 1, 0}}};
  EXPECT_TRUE(guard.allows(first, std::vector{up}));
  guard.add({{6, 7, 8}, {Vec3{0, 0, 0.1}, Vec3{1, 0, 0.1}, Vec3{0, 1, 0.1}}}, 0);
  EXPECT_EQ(guard.num_triangles(), 3);
  EXPECT_FALSE(guard.allows(first, std::vector{up}));
}

PatchSurface hollow_ball(double inner_radius)
{
  PatchSurface shells;
  add_patch(sphere_soup(4), inner_radius, {}, shells);
  add_patch(sphere_soup(4), 1.0, {}, shells);
  for (std::size_t t = 0; t < shells.triangles.size(); ++t) {
    if (shells.triangle_patch[t] == 0) std::swap(shells.triangles[t][1], shells.triangles[t][2]);
  }
  return shells;
}

CoarseOptions rough()
{
  CoarseOptions options;
  options.max_size = 0.8;
  options.curvature = 0.5;
  return options;
}

double longest_edge(const PatchSurface& surface)
{
  double longest = 0.0;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const auto p = surface.corners(t);
    for (std::size_t c = 0; c < 3; ++c) longest = std::max(longest, norm(p[(c + 1) % 3] - p[c]));
  }
  return longest;
}

TEST(RemeshOfWalls, SheetsThatAreNearDoNotCutEachOther)
{
  const SurfaceReference reference(hollow_ball(0.98));
  ASSERT_TRUE(find_overlaps(reference.surface()).empty());
  const PatchSurface surface = remesh(reference, rough());
  EXPECT_NO_THROW(validate(surface));
  EXPECT_TRUE(find_overlaps(surface).empty());
}

TEST(RemeshOfWalls, EdgesAreAFewTimesTheWallAndNotMuchLess)
{
  const PatchSurface thin = remesh(SurfaceReference(hollow_ball(0.96)), rough());
  const PatchSurface thick = remesh(SurfaceReference(hollow_ball(0.5)), rough());
  EXPECT_GT(longest_edge(thick), 0.6);
  // Eight times 0.04; a length is 1.18 times its size, and is not split up to 1.4 times.
  EXPECT_LT(longest_edge(thin), 8.0 * 0.04 * 1.18 * 1.4);
  EXPECT_GT(longest_edge(thin), 0.2);
}

TEST(RemeshOfWalls, FlatSheetsBesideAGapAreNotLimited)
{
  const auto num_triangles = [](double gap) {
    PatchSurface cubes;
    add_patch(cube_soup(), 1.0, {}, cubes);
    add_patch(cube_soup(), 1.0, {1.0 + gap, 0.0, 0.0}, cubes);
    for (char& is_fixed : cubes.vertex_is_fixed) is_fixed = 1;
    CoarseOptions options;
    options.max_size = 0.5;
    options.curvature = 0.01;
    return static_cast<double>(remesh(SurfaceReference(cubes), options).triangles.size());
  };
  EXPECT_NEAR(num_triangles(0.01), num_triangles(5.0), 10.0);
}

// Spheres with chords that are off them by up to 0.03, put on the spheres; the inner one comes
// first and has to go outwards.
PatchSurface shells_on_spheres(double inner)
{
  PatchSurface shells;
  add_patch(sphere_soup(2), inner, {}, shells);
  add_patch(sphere_soup(2), 1.0, {}, shells);
  const SurfaceReference reference(shells);
  CoarseOptions finer = rough();
  finer.max_size *= 0.35;
  PatchSurface surface = remesh(reference, shells, SizeFunction(finer)).surface;
  EXPECT_TRUE(find_overlaps(surface).empty());
  EXPECT_GT(surface.triangles.size(), shells.triangles.size());
  put_on_geometry(surface, reference, testing::SphereModel({inner, 1.0}));
  return surface;
}

TEST(PutOnGeometry, StopsVerticesBeforeTheyGoThroughAnotherSheet)
{
  EXPECT_TRUE(find_overlaps(shells_on_spheres(0.995)).empty());
}

TEST(PutOnGeometry, TriesThoseAgainThatAnotherSheetHeldBack)
{
  const double inner = 0.96;
  const PatchSurface surface = shells_on_spheres(inner);
  EXPECT_TRUE(find_overlaps(surface).empty());
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const double radius = surface.triangle_patch[t] == 0 ? inner : 1.0;
    for (const Vec3& corner : surface.corners(t)) EXPECT_NEAR(norm(corner), radius, 1e-9);
  }
}

TEST(SizeFunction, GrowsFromItsSources)
{
  SizeFunction sizes({.max_size = 2.0, .grading = 0.1});
  EXPECT_EQ(sizes({5.0, 5.0, 5.0}), 2.0);
  sizes.limit({{{Vec3{0.0, 0.0, 0.0}, Vec3{1.0, 0.0, 0.0}, Vec3{1.0, 0.0, 0.0}}, 0.5}});
  EXPECT_EQ(sizes({0.3, 0.0, 0.0}), 0.5) << "on a segment";
  const double near = sizes({0.3, 1.0, 0.0});
  EXPECT_GT(near, 0.5);
  EXPECT_NEAR(sizes({0.3, 0.0, 2.0}) - near, near - 0.5, 1e-12) << "as the distance does";
  EXPECT_EQ(sizes({0.0, 50.0, 0.0}), 2.0);
}

TEST(SizeFunction, MakesEdgesShorterAroundASource)
{
  PatchSurface ball;
  add_patch(sphere_soup(3), 1.0, {}, ball);
  const SurfaceReference reference(ball);
  CoarseOptions options = rough();
  options.max_size = 0.3;
  SizeFunction sizes = size_function_of(reference, options);
  const PatchSurface before = remesh(reference, ball, sizes).surface;
  const Vec3 place = before.vertex_xyz[0];
  sizes.limit({{{place, place, place}, 0.1 * sizes(place)}});
  const PatchSurface after = remesh(reference, before, sizes).surface;
  EXPECT_NO_THROW(validate(after));
  EXPECT_GT(after.triangles.size(), before.triangles.size() + 10);
}

}  // namespace
}  // namespace tessera::surface
