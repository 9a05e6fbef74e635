// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/surface/flat_contacts.hpp"

#include <gtest/gtest.h>

#include "support/patch_surfaces.hpp"
#include "support/stl_models.hpp"

namespace tessera::surface {
namespace {

constexpr double kTolerance = 1e-6;

PatchSurface two_cubes(const Vec3& shift)
{
  PatchSurface surface;
  testing::add_patch(testing::cube_soup(), 1.0, {}, surface);
  testing::add_patch(testing::cube_soup(), 1.0, shift, surface);
  return surface;
}

TEST(FlatContacts, ThereIsNoneInABodyNorWhereBodiesMeetInAnEdgeOrCutEachOther)
{
  EXPECT_TRUE(find_flat_contacts(two_cubes({1.5, 0.0, 0.0}), kTolerance).empty());
  EXPECT_TRUE(find_flat_contacts(two_cubes({1.0, 1.0, 0.2}), kTolerance).empty());
  EXPECT_TRUE(find_flat_contacts(two_cubes({0.6, 0.7, 0.8}), kTolerance).empty());
}

TEST(FlatContacts, AreFoundWhereSidesOfBodiesLieOnEachOther)
{
  for (const double gap : {-1e-7, 0.0, 1e-7}) {
    const PatchSurface surface = two_cubes({1.0 + gap, 0.3, 0.4});
    const auto contacts = find_flat_contacts(surface, kTolerance);
    ASSERT_FALSE(contacts.empty());
    for (const auto& [first, second] : contacts) {
      EXPECT_EQ(surface.triangle_patch[first], 0);
      EXPECT_EQ(surface.triangle_patch[second], 1);
    }
  }
  EXPECT_TRUE(find_flat_contacts(two_cubes({1.0 + 1e-5, 0.3, 0.4}), kTolerance).empty());
}

}  // namespace
}  // namespace tessera::surface
