// SPDX-License-Identifier: BSD-3-Clause
// The boundary file against the mesh: one mutation each.
#include <cmath>

#include <gtest/gtest.h>

#include "support/meshes.hpp"

#include "check_everywhere.hpp"

namespace tessera::testing {
namespace {

MeshFiles good_files() { return slice(two_material_cube(4), 4); }

TEST(CheckBoundary, GoodFilesHaveNoDefect)
{
  const check::CheckReport report = check_everywhere(good_files());
  EXPECT_TRUE(report.conforms) << to_json(report);
  EXPECT_EQ(report.num_interface_triangles, 2 * 16);
}

TEST(CheckBoundary, MissingTriangle)
{
  MeshFiles files = good_files();
  mesh::MeshArrays& piece = files.boundary[0];
  piece.cell_points.erase(piece.cell_points.begin(), piece.cell_points.begin() + 3);
  piece.cell_ints["patch"].pop_back();
  piece.cell_ints["subdomain"].pop_back();
  auto& tets = piece.cell_longs["tet"];
  const GlobalIndex tet = tets[0];
  tets.erase(tets.begin());
  const check::CheckReport report = check_everywhere(files);
  EXPECT_EQ(count(report, "boundary_missing"), 1) << to_json(report);
  EXPECT_TRUE(names(report, "boundary_missing", {"(id " + std::to_string(tet) + ")", "piece 0"}));
  EXPECT_EQ(report.num_open_seam_triangles, 1);
}

TEST(CheckBoundary, TriangleThatNamesTheWrongTet)
{
  MeshFiles files = good_files();
  files.boundary[1].cell_longs["tet"][2] = 5;
  const check::CheckReport report = check_everywhere(files);
  EXPECT_EQ(report.defects.size(), 1U) << to_json(report);
  EXPECT_TRUE(names(report, "boundary_tet", {"triangle 2 of boundary piece 1", "names tet 5"}));
}

TEST(CheckBoundary, TriangleThatPointsInwards)
{
  MeshFiles files = good_files();
  auto& points = files.boundary[3].cell_points;
  std::swap(points[3], points[4]);
  const check::CheckReport report = check_everywhere(files);
  EXPECT_EQ(report.defects.size(), 1U) << to_json(report);
  EXPECT_TRUE(names(report, "boundary_orientation", {"triangle 1 of boundary piece 3"}));
}

TEST(CheckBoundary, TriangleThatNamesTheWrongSubdomain)
{
  MeshFiles files = good_files();
  files.boundary[2].cell_ints["subdomain"][0] = 1;
  const check::CheckReport report = check_everywhere(files);
  EXPECT_EQ(report.defects.size(), 1U) << to_json(report);
  EXPECT_TRUE(names(report, "boundary_subdomain", {"triangle 0 of boundary piece 2"}));
}

TEST(CheckBoundary, TriangleListedTwice)
{
  MeshFiles files = good_files();
  files.boundary.push_back(files.boundary[2]);
  const check::CheckReport report = check_everywhere(files);
  EXPECT_EQ(count(report, "boundary_twice"), files.boundary[2].num_cells());
  EXPECT_TRUE(names(report, "boundary_twice", {"boundary piece 2", "boundary piece 4"}));
}

TEST(CheckBoundary, TriangleThatIsNoFaceOfATet)
{
  MeshFiles files = good_files();
  mesh::MeshArrays& piece = files.boundary[0];
  const auto last = static_cast<LocalIndex>(piece.num_points() - 1);
  piece.cell_points.insert(piece.cell_points.end(), {0, last / 2, last});
  piece.cell_ints["patch"].push_back(0);
  piece.cell_ints["subdomain"].push_back(0);
  piece.cell_longs["tet"].push_back(0);
  const check::CheckReport report = check_everywhere(files);
  EXPECT_EQ(report.defects.size(), 1U) << to_json(report);
  EXPECT_EQ(count(report, "boundary_extra"), 1);
}

TEST(CheckBoundary, SeamOfOneMaterialIsNoBoundary)
{
  MeshFiles files = good_files();
  for (mesh::MeshArrays& piece : files.tets) piece.cell_ints["attribute"].assign(96, 1);
  const check::CheckReport report = check_everywhere(files);
  EXPECT_EQ(count(report, "boundary_extra"), 2 * 16);
}

TEST(CheckBoundary, PointWhosePositionIsNotTheMeshs)
{
  MeshFiles files = good_files();
  double& x = files.boundary[1].point_xyz[0];
  x = std::nextafter(x, 2.0);
  const check::CheckReport report = check_everywhere(files);
  EXPECT_EQ(report.defects.size(), 1U) << to_json(report);
  EXPECT_TRUE(names(report, "boundary_point", {"boundary piece 1: point 0"}));
}

TEST(CheckBoundary, MissingTetShowsAsNewBoundary)
{
  MeshFiles files = good_files();
  mesh::MeshArrays& piece = files.tets[1];
  piece.cell_points.resize(piece.cell_points.size() - 4);
  piece.cell_ids.pop_back();
  piece.cell_ints["attribute"].pop_back();
  const check::CheckReport report = check_everywhere(files);
  EXPECT_GT(count(report, "boundary_missing"), 0);
  EXPECT_EQ(report.num_open_seam_triangles, count(report, "boundary_missing"));
  EXPECT_EQ(count(report, "cell_id_hole"), 1);
}

TEST(CheckBoundary, FileWithoutIdsIsComparedByPosition)
{
  MeshFiles files = good_files();
  for (mesh::MeshArrays& piece : files.boundary) {
    piece.point_ids.clear();
    piece.cell_ints.clear();
    piece.cell_longs.clear();
  }
  const check::CheckReport report = check_everywhere(files);
  EXPECT_TRUE(report.conforms) << to_json(report);
  EXPECT_FALSE(report.matched_by_ids);
  EXPECT_GE(report.notes.size(), 3U);
}

}  // namespace
}  // namespace tessera::testing
