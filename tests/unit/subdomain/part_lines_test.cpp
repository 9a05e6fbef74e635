// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/subdomain/part_lines.hpp"

#include <gtest/gtest.h>

namespace tessera::subdomain {
namespace {

using Ints = std::vector<std::int32_t>;

// Three edges from the origin up to z = 3, on two lines. Files share the point at z = 2, so it
// stands twice.
mesh::MeshArrays two_lines()
{
  return {.vertices_per_cell = 2,
          .are_edges = true,
          .point_xyz = {0, 0, 0, 0, 0, 1, 0, 0, 2, 0, 0, 2, 0, 0, 3},
          .cell_points = {0, 1, 1, 2, 4, 3},
          .cell_ids = {0, 1, 2},
          .cell_ints = {{"line", {5, 5, 7}}},
          .field_texts = {{"line_names", {"well"}}}};
}

// Tets of one part along all of these; their points come from the top down.
mesh::MeshArrays tets_along()
{
  return {.point_xyz = {0, 0, 3, 0, 0, 2, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0},
          .cell_points = {4, 5, 1, 0, 4, 5, 2, 1, 4, 5, 3, 2},
          .point_ids = {30, 20, 10, 0, 40, 50},
          .point_ints = {{"owner", {3, 2, 1, 0, 4, 5}}}};
}

TEST(LinesOfPart, HaveThePointsOfItsTets)
{
  const mesh::MeshArrays own = lines_of_part(two_lines(), {6, 6, 6}, 6, tets_along());
  EXPECT_EQ(own.num_cells(), 3);
  EXPECT_EQ(own.num_points(), 4);  // What stood twice is one point.
  for (std::size_t p = 0; p < own.point_ids.size(); ++p) {
    EXPECT_EQ(10.0 * own.point_xyz[3 * p + 2], static_cast<double>(own.point_ids[p]));
    EXPECT_EQ(own.point_ints.at("owner")[p], own.point_ids[p] / 10);
  }
  for (std::size_t e = 0; e < 3; ++e) {
    const GlobalIndex a = own.point_ids[at(own.cell_points[2 * e])];
    const GlobalIndex b = own.point_ids[at(own.cell_points[2 * e + 1])];
    EXPECT_EQ(a + b, 10 + 20 * static_cast<GlobalIndex>(e));
  }
  EXPECT_EQ(own.cell_ids, (std::vector<GlobalIndex>{0, 1, 2}));
  EXPECT_EQ(own.cell_ints.at("line"), (Ints{5, 5, 7}));
  EXPECT_EQ(own.cell_ints.at("subdomain"), (Ints{6, 6, 6}));
  EXPECT_EQ(own.field_texts.at("line_names").front(), "well");
  EXPECT_TRUE(own.are_edges);
}

TEST(LinesOfPart, AreThoseOfThePartAlone)
{
  const mesh::MeshArrays own = lines_of_part(two_lines(), {6, 2, 6}, 2, tets_along());
  EXPECT_EQ(own.cell_ids, (std::vector<GlobalIndex>{1}));
  EXPECT_EQ(own.cell_ints.at("line"), Ints{5});
  EXPECT_EQ(own.num_points(), 2);
}

TEST(LinesOfPart, AreNoneWhereThePartHasNone)
{
  const mesh::MeshArrays own = lines_of_part(two_lines(), {6, 2, kNoIndex}, 1, tets_along());
  EXPECT_EQ(own.num_cells(), 0);
  EXPECT_EQ(own.num_points(), 0);
  EXPECT_EQ(own.field_texts.size(), 1U);
  EXPECT_TRUE(own.cell_ints.at("line").empty());
}

}  // namespace
}  // namespace tessera::subdomain
