// SPDX-License-Identifier: BSD-3-Clause
#include "surface/remesh/patch_parts.hpp"

#include <algorithm>
#include <optional>
#include <vector>

#include <gtest/gtest.h>

namespace tessera::surface {
namespace {

using Triangle = PatchSurface::Triangle;

// Two patches over one square, whose sides are a curve each; the first is a pyramid with its top
// inside, the second is cut by a diagonal.
PatchSurface tent()
{
  PatchSurface surface;
  surface.vertex_xyz = {{0, 0, 0}, {1, 0, 0}, {0.5, 0.5, 1}, {1, 1, 0}, {0, 1, 0}};
  surface.vertex_is_fixed = {1, 1, 0, 1, 1};
  surface.triangles = {{0, 1, 2}, {1, 3, 2}, {3, 4, 2}, {4, 0, 2}, {0, 3, 1}, {0, 4, 3}};
  surface.triangle_patch = {0, 0, 0, 0, 1, 1};
  surface.patch_materials = {{1, 0}, {1, 0}};
  surface.edges = {{0, 1}, {0, 4}, {1, 3}, {3, 4}};
  surface.edge_curve = {0, 1, 2, 3};
  return surface;
}

// The first patch with a diagonal in place of its top. Its vertices are 0, 1, 3 and 4 of the whole.
PatchSurface flat_roof(const PatchPart& part, bool is_from_first)
{
  PatchSurface roof = part.surface;
  roof.vertex_xyz.pop_back();
  roof.vertex_is_fixed.pop_back();
  roof.triangles = is_from_first ? std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}}
                                 : std::vector<Triangle>{{0, 1, 3}, {1, 2, 3}};
  roof.triangle_patch = {0, 0};
  return roof;
}

TEST(PatchParts, ARimIsWhatOthersTouch)
{
  const std::vector<PatchPart> parts = patch_parts_of(tent());
  ASSERT_EQ(parts.size(), 2U);
  EXPECT_EQ(parts[0].rim, (std::vector<LocalIndex>{0, 1, 3, 4}));
  EXPECT_EQ(parts[0].inside, (std::vector<LocalIndex>{2}));
  EXPECT_EQ(parts[0].surface.vertex_is_fixed, (std::vector<char>{1, 1, 1, 1, 0}));
  EXPECT_EQ(parts[0].surface.triangles.front(), (Triangle{0, 1, 4}));
  EXPECT_EQ(parts[0].surface.edges.size(), 4U);
  EXPECT_TRUE(parts[1].inside.empty());
  EXPECT_EQ(parts[1].surface.triangle_patch, (std::vector<LocalIndex>{1, 1}));
}

TEST(PatchParts, WithoutAnEditAllIsAsItWas)
{
  const PatchSurface whole = tent();
  const auto [surface, is_edited] =
      join_patches(whole, patch_parts_of(whole), {std::nullopt, std::nullopt});
  EXPECT_EQ(surface.vertex_xyz, whole.vertex_xyz);
  EXPECT_EQ(surface.vertex_is_fixed, whole.vertex_is_fixed);
  EXPECT_EQ(surface.triangles, whole.triangles);
  EXPECT_EQ(surface.triangle_patch, whole.triangle_patch);
  EXPECT_EQ(surface.edges, whole.edges);
  EXPECT_EQ(surface.edge_curve, whole.edge_curve);
  EXPECT_EQ(is_edited, (std::vector<char>{0, 0}));
}

TEST(PatchParts, AnEditedPartTakesItsPlace)
{
  const PatchSurface whole = tent();
  const std::vector<PatchPart> parts = patch_parts_of(whole);
  const auto [surface, is_edited] =
      join_patches(whole, parts, {flat_roof(parts[0], false), std::nullopt});
  EXPECT_EQ(is_edited, (std::vector<char>{1, 0}));
  EXPECT_EQ(surface.vertex_xyz.size(), 4U) << "the top has gone";
  EXPECT_NO_THROW(validate(surface));
  EXPECT_EQ(surface.triangles.size(), 4U);
}

TEST(PatchParts, NewVerticesComeBehindTheOthers)
{
  const PatchSurface whole = tent();
  const std::vector<PatchPart> parts = patch_parts_of(whole);
  PatchSurface higher = parts[0].surface;
  higher.vertex_xyz.back() = {0.5, 0.5, 2};
  const PatchSurface surface = join_patches(whole, parts, {higher, std::nullopt}).surface;
  ASSERT_EQ(surface.vertex_xyz.size(), 5U);
  EXPECT_EQ(surface.vertex_xyz.back(), (Vec3{0.5, 0.5, 2}));
  EXPECT_EQ(surface.triangles.front(), (Triangle{0, 1, 4}));
  EXPECT_EQ(surface.vertex_is_fixed.back(), 0);
}

// Four triangles would meet in the diagonal.
TEST(PatchParts, WhatTakesAnEdgeOfAnotherPatchStaysAsItWas)
{
  const PatchSurface whole = tent();
  const std::vector<PatchPart> parts = patch_parts_of(whole);
  const auto [surface, is_edited] =
      join_patches(whole, parts, {flat_roof(parts[0], true), std::nullopt});
  EXPECT_EQ(is_edited, (std::vector<char>{0, 0}));
  EXPECT_EQ(surface.triangles, whole.triangles);
}

// The same where the diagonal is a curve on which two other patches stand.
TEST(PatchParts, WhatTakesAnEdgeOfACurveStaysAsItWas)
{
  PatchSurface whole = tent();
  whole.triangles[4] = {0, 4, 1};
  whole.triangles[5] = {4, 3, 1};
  whole.vertex_xyz.push_back({0.5, 0.5, -1});
  whole.vertex_is_fixed.push_back(1);
  whole.triangles.insert(whole.triangles.end(), {{0, 3, 5}, {3, 0, 5}});
  whole.triangle_patch.insert(whole.triangle_patch.end(), {2, 3});
  whole.patch_materials.assign(4, {1, 0});
  whole.edges = {{0, 1}, {0, 3}, {0, 4}, {0, 5}, {1, 3}, {3, 4}, {3, 5}};
  whole.edge_curve = {0, 4, 1, 5, 2, 3, 6};
  const std::vector<PatchPart> parts = patch_parts_of(whole);
  ASSERT_EQ(parts.size(), 4U);
  const auto [surface, is_edited] = join_patches(
      whole, parts, {flat_roof(parts[0], true), std::nullopt, std::nullopt, std::nullopt});
  EXPECT_EQ(is_edited, (std::vector<char>{0, 0, 0, 0}));
  EXPECT_EQ(surface.triangles, whole.triangles);
}

}  // namespace
}  // namespace tessera::surface
