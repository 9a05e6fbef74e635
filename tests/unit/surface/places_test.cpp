// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/surface/places.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "tessera/base/bytes.hpp"
#include "tessera/base/error.hpp"

#include "support/stl_models.hpp"

namespace tessera::surface {
namespace {

using testing::cube_soup;

SurfacePlaces places_of(const model::TriangleSoup& soup)
{
  return find_places(model::welded_surface(soup));
}

TEST(SurfacePlaces, OfABodyThereIsNone)
{
  const SurfacePlaces found = places_of(cube_soup());
  EXPECT_TRUE(found.places.empty());
  EXPECT_EQ(found.num_triangles(), 12U);
  EXPECT_TRUE(std::ranges::all_of(found.triangle_counts, [](int count) { return count == 0; }));
}

TEST(SurfacePlaces, OfAHoleAreItsEdges)
{
  model::TriangleSoup soup = cube_soup();
  testing::remove_triangle(soup, 11);
  const SurfacePlaces found = places_of(soup);
  EXPECT_EQ(found.count(PlaceKind::open_edge), 3U);
  EXPECT_EQ(found.places.size(), 3U);
  EXPECT_EQ(std::ranges::count_if(found.triangle_counts, [](int count) { return count > 0; }), 3);
}

TEST(SurfacePlaces, OfCubesAtOneEdgeIsThatEdge)
{
  const SurfacePlaces found = places_of(testing::joined(cube_soup(), cube_soup({1.0, 1.0, 0.0})));
  ASSERT_EQ(found.places.size(), 1U);
  EXPECT_EQ(found.places[0].kind, PlaceKind::crowded_edge);
  EXPECT_EQ(found.places[0].middle(), (Vec3{1.0, 1.0, 0.5}));
}

TEST(SurfacePlaces, OfBodiesThatCrossArePairs)
{
  const SurfacePlaces found = places_of(testing::joined(cube_soup(), cube_soup({0.6, 0.7, 0.8})));
  EXPECT_GT(found.count(PlaceKind::crossing), 0U);
  EXPECT_EQ(found.count(PlaceKind::crossing), found.places.size());
  for (const Place& place : found.places) {
    for (const double x : place.middle()) {
      EXPECT_GE(x, 0.6 - 1e-12);
      EXPECT_LE(x, 1.0 + 1e-12);
    }
  }
}

TEST(SurfacePlaces, DamagedBytesAreRefused)
{
  SurfacePlaces found = places_of(cube_soup());
  EXPECT_NO_THROW((void)from_bytes<SurfacePlaces>(to_bytes(found)));
  found.triangle_vertices[4] = 99;
  EXPECT_THROW((void)from_bytes<SurfacePlaces>(to_bytes(found)), InputError);
}

}  // namespace
}  // namespace tessera::surface
