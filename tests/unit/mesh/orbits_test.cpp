// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/mesh/orbits.hpp"

#include <array>

#include <gtest/gtest.h>

#include "tessera/mesh/orbit_walk.hpp"

namespace tessera::mesh {
namespace {

using Rows = std::vector<LocalIndex>;

const std::vector<Affine> kTransforms{{}, {.shift = {1.0, 0.0, 0.0}}, {.shift = {0.0, 1.0, 0.0}}};

// The corners of a square: 0 and 3 are each other's images by two ways.
const std::vector<ImageLink> kSquare{
    {.from = 1, .to = 0, .transform = 1},
    {.from = 2, .to = 0, .transform = 2},
    {.from = 3, .to = 1, .transform = 2},
    {.from = 3, .to = 2, .transform = 1},
};

Rows to_rows(const FlatArray<LocalIndex>& array) { return {array.begin(), array.end()}; }

PointLimit on_edge(LocalIndex edge, double factor)
{
  return {LatticePointKey::on_edge(edge, 2, 1), factor};
}

TEST(WalkOrbits, ReachesEachRowOnce)
{
  std::vector<std::array<LocalIndex, 3>> visits;
  walk_orbits(6, kSquare, [&](LocalIndex here, LocalIndex there, const ImageLink& link) {
    visits.push_back({here, there, link.transform});
  });
  EXPECT_EQ(visits, (std::vector<std::array<LocalIndex, 3>>{{0, 1, 1}, {0, 2, 2}, {1, 3, 2}}));
}

TEST(WalkOrbits, GoesNowhereWithoutLinks)
{
  int num_visits = 0;
  const auto count = [&](LocalIndex, LocalIndex, const ImageLink&) { ++num_visits; };
  walk_orbits(0, {}, count);
  walk_orbits(3, {}, count);
  walk_orbits(3, std::vector<ImageLink>{{.from = 2, .to = 2}}, count);
  EXPECT_EQ(num_visits, 0);
}

TEST(FindOrbits, StartAtTheLowestRow)
{
  std::vector<Affine> images{{}};
  const OrbitTable table = find_orbits(5, kSquare, kTransforms, images);
  EXPECT_EQ(to_rows(table.base), (Rows{0, 0, 0, 0, 4}));
  // Links were followed backwards.
  EXPECT_EQ(images[at(table.image_of(1))].shift, (Vec3{-1.0, 0.0, 0.0}));
  EXPECT_EQ(images[at(table.image_of(2))].shift, (Vec3{0.0, -1.0, 0.0}));
  EXPECT_EQ(images[at(table.image_of(3))].shift, (Vec3{-1.0, -1.0, 0.0}));
  EXPECT_EQ(table.image_of(0), 0);
  EXPECT_EQ(table.image_of(4), 0);
  EXPECT_EQ(table.origin_of(3), 0);
  EXPECT_EQ(table.origin_of(4), 4);
}

// The two sides of a split are at one place, so each has the bits by itself.
TEST(FindOrbits, OfASplitAreComputedWhereTheyAre)
{
  std::vector<Affine> images{{}};
  const std::vector<ImageLink> split{{.from = 0, .to = 2, .transform = 0}};
  const OrbitTable table = find_orbits(3, split, kTransforms, images);
  EXPECT_EQ(table.base_of(2), 0);
  EXPECT_EQ(table.image_of(2), 0);
  EXPECT_EQ(table.origin_of(2), 2);
  EXPECT_EQ(images.size(), 1U);
}

TEST(FindOrbits, MakeEachProductOnce)
{
  std::vector<Affine> images{{}};
  const std::vector<ImageLink> two{{.from = 0, .to = 1, .transform = 1},
                                   {.from = 2, .to = 3, .transform = 1},
                                   {.from = 5, .to = 4, .transform = 1}};
  const OrbitTable table = find_orbits(6, two, kTransforms, images);
  EXPECT_EQ(images.size(), 3U);  // The identity, there, and back.
  EXPECT_EQ(table.image_of(1), table.image_of(3));
  EXPECT_NE(table.image_of(1), table.image_of(5));
}

TEST(OnWholeOrbits, GiveAllMembersTheSameLimit)
{
  std::vector<Affine> images{{}};
  Orbits orbits;
  orbits.edges = find_orbits(5, kSquare, kTransforms, images);
  orbits.triangles = find_orbits(3, {}, kTransforms, images);
  orbits.images = images;
  const PointLimit in_triangle{LatticePointKey::on_triangle(2, 4, {1, 1}), 0.25};
  const std::vector<PointLimit> all =
      on_whole_orbits({on_edge(2, 0.5), on_edge(4, 0.75), in_triangle}, orbits);
  EXPECT_EQ(all, (std::vector<PointLimit>{on_edge(0, 0.5), on_edge(1, 0.5), on_edge(2, 0.5),
                                          on_edge(3, 0.5), on_edge(4, 0.75), in_triangle}));
}

TEST(OnWholeOrbits, LeaveLimitsWithoutOrbits)
{
  const std::vector<PointLimit> limits{on_edge(7, 0.5)};
  EXPECT_EQ(on_whole_orbits(limits, {}), limits);
}

}  // namespace
}  // namespace tessera::mesh
