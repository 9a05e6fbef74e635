// SPDX-License-Identifier: BSD-3-Clause
// One mutation of a good mesh each: it is found and named.
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "support/meshes.hpp"

#include "check_everywhere.hpp"

namespace tessera::testing {
namespace {

// Three slices without a boundary file: the tets alone must show the defect.
MeshFiles good_files()
{
  MeshFiles files = slice(kuhn_cube(3), 3);
  files.boundary.clear();
  return files;
}

// Removes the last tet of a piece.
void remove_last_tet(mesh::MeshArrays& piece)
{
  piece.cell_points.resize(piece.cell_points.size() - 4);
  piece.cell_ids.pop_back();
  piece.cell_ints["attribute"].pop_back();
}

void add_tet(mesh::MeshArrays& piece, const std::array<LocalIndex, 4>& points, GlobalIndex id)
{
  piece.cell_points.insert(piece.cell_points.end(), points.begin(), points.end());
  piece.cell_ids.push_back(id);
  piece.cell_ints["attribute"].push_back(1);
}

// Adds a point that no cell uses yet. @return its row.
LocalIndex add_point(mesh::MeshArrays& piece, const Vec3& position, GlobalIndex id)
{
  piece.point_xyz.insert(piece.point_xyz.end(), position.begin(), position.end());
  piece.point_ids.push_back(id);
  return static_cast<LocalIndex>(piece.num_points() - 1);
}

TEST(CheckDefects, GoodFilesHaveNone)
{
  const check::CheckReport report = check_everywhere(good_files());
  EXPECT_TRUE(report.conforms) << to_json(report);
}

TEST(CheckDefects, FlippedTet)
{
  MeshFiles files = good_files();
  std::swap(files.tets[1].cell_points[4 * 7], files.tets[1].cell_points[4 * 7 + 1]);
  const check::CheckReport report = check_everywhere(files);
  EXPECT_EQ(count(report, "non_positive_volume"), 1);
  EXPECT_TRUE(names(report, "non_positive_volume", {"cell 7 (id 61) of piece 1"}));
  EXPECT_GT(count(report, "triangle"), 0);
}

TEST(CheckDefects, SharedPointMovedByOneBitInOnePiece)
{
  MeshFiles files = good_files();
  const GlobalIndex id = shared_point(files.tets[0], files.tets[1]);
  double& y = files.tets[1].point_xyz[3 * row_of_point(files.tets[1], id) + 1];
  y = std::nextafter(y, 2.0);
  const check::CheckReport report = check_everywhere(files);
  EXPECT_EQ(report.defects.size(), 1U) << to_json(report);
  EXPECT_EQ(count(report, "point_position"), 1);
  EXPECT_TRUE(
      names(report, "point_position", {"id " + std::to_string(id) + ")", "piece 0", "piece 1"}));
}

TEST(CheckDefects, SharedPointMovedByOneBitInAMeshWithoutIdsOpensACrack)
{
  MeshFiles files = slice(kuhn_cube(4), 4);
  files.boundary.clear();
  mesh::MeshArrays& piece = files.tets[1];
  for (std::size_t p = 0; p < piece.point_ids.size(); ++p) {
    const Vec3 x = point_at(std::span<const double>(piece.point_xyz), p);
    if (x == Vec3{0.5, 0.5, 0.5}) piece.point_xyz[3 * p] = std::nextafter(0.5, 1.0);
  }
  for (mesh::MeshArrays& other : files.tets) other.point_ids.clear();
  EXPECT_GT(count(check_everywhere(files), "folded_boundary"), 0);
}

TEST(CheckDefects, PointIdTwiceInOnePiece)
{
  MeshFiles files = good_files();
  const GlobalIndex repeated = files.tets[2].point_ids.back();
  files.tets[2].point_ids[0] = repeated;
  const check::CheckReport report = check_everywhere(files);
  EXPECT_EQ(count(report, "point_id_twice"), 1);
  EXPECT_TRUE(names(report, "point_id_twice", {"piece 2", "id " + std::to_string(repeated)}));
}

TEST(CheckDefects, IdOfAPointGivenToAPointInsideAnotherPiece)
{
  // Half a cube of 8 cells a side has inner points.
  MeshFiles files = slice(kuhn_cube(8), 2);
  files.boundary.clear();
  const auto inner_row = [](const mesh::MeshArrays& piece, double x) {
    for (std::size_t p = 0;; ++p)
      if (point_at(std::span<const double>(piece.point_xyz), p) == Vec3{x, 0.5, 0.5}) return p;
  };
  const GlobalIndex id = files.tets[0].point_ids[inner_row(files.tets[0], 0.25)];
  GlobalIndex& lost = files.tets[1].point_ids[inner_row(files.tets[1], 0.75)];
  const std::string lost_text = std::to_string(lost);
  lost = id;
  const check::CheckReport report = check_everywhere(files);
  EXPECT_TRUE(names(report, "point_id_twice", {"id " + std::to_string(id) + " ", "piece 0 1"}));
  EXPECT_TRUE(names(report, "point_id_hole", {"id " + lost_text + ","}));
}

TEST(CheckDefects, HolesInIds)
{
  MeshFiles files = good_files();
  for (GlobalIndex& id : files.tets[2].cell_ids) id += 5;
  for (mesh::MeshArrays& piece : files.tets)
    for (GlobalIndex& id : piece.point_ids) id += id > 20 ? 1 : 0;
  const check::CheckReport report = check_everywhere(files);
  EXPECT_EQ(count(report, "cell_id_hole"), 5);
  EXPECT_TRUE(names(report, "cell_id_hole", {"id 108,"}));
  EXPECT_EQ(count(report, "point_id_hole"), 1);
  EXPECT_TRUE(names(report, "point_id_hole", {"id 21,"}));
  EXPECT_FALSE(report.matched_by_ids);
  EXPECT_EQ(report.euler_characteristic, 1);
}

TEST(CheckDefects, NegativeIds)
{
  MeshFiles files = good_files();
  files.tets[0].cell_ids[0] = -1;
  const check::CheckReport report = check_everywhere(files);
  EXPECT_TRUE(names(report, "cell_id_hole", {"piece 0", "id -1"}));
}

TEST(CheckDefects, CellIdTwice)
{
  MeshFiles files = good_files();
  files.tets[1].cell_ids[0] = 3;
  const check::CheckReport report = check_everywhere(files);
  EXPECT_EQ(count(report, "cell_id_twice"), 1);
  EXPECT_TRUE(names(report, "cell_id_twice", {"cell id 3 ", "piece 0 1"}));
  EXPECT_TRUE(names(report, "cell_id_hole", {"id 54,"}));
}

TEST(CheckDefects, DuplicateTetInOnePiece)
{
  MeshFiles files = good_files();
  mesh::MeshArrays& piece = files.tets[1];
  const auto& p = piece.cell_points;
  add_tet(piece, {p[40], p[41], p[42], p[43]}, 162);
  const check::CheckReport report = check_everywhere(files);
  EXPECT_EQ(count(report, "duplicate_tet"), 1);
  EXPECT_TRUE(names(report, "duplicate_tet", {"cell 10 (id 64)", "(id 162) of piece 1"}));
  EXPECT_GT(count(report, "triangle"), 0);
}

TEST(CheckDefects, DuplicateTetInAnotherPiece)
{
  for (const bool has_ids : {true, false}) {
    MeshFiles files = good_files();
    mesh::MeshArrays copy;
    for (std::size_t corner = 0; corner < 4; ++corner) {
      const auto row = static_cast<std::size_t>(files.tets[1].cell_points[40 + corner]);
      add_point(copy, point_at(std::span<const double>(files.tets[1].point_xyz), row),
                files.tets[1].point_ids[row]);
    }
    add_tet(copy, {0, 1, 2, 3}, 162);
    files.tets.push_back(copy);
    if (!has_ids)
      for (mesh::MeshArrays& piece : files.tets) piece.point_ids.clear();
    const check::CheckReport report = check_everywhere(files);
    EXPECT_FALSE(report.conforms);
    EXPECT_TRUE(names(report, "triangle", {"(id 162) of piece 3", "(id 64) of piece 1"}));
  }
}

TEST(CheckDefects, TetWithAnInnerPointInAnotherPieceAsWell)
{
  for (const bool has_ids : {true, false}) {
    MeshFiles files = slice(kuhn_cube(4), 1);
    files.boundary.clear();
    mesh::MeshArrays copy;
    const auto rows = std::span(files.tets[0].cell_points).last(4);
    for (const LocalIndex row : rows)
      add_point(copy, point_at(std::span<const double>(files.tets[0].point_xyz), row),
                files.tets[0].point_ids[static_cast<std::size_t>(row)]);
    add_tet(copy, {0, 1, 2, 3}, 384);
    files.tets.push_back(copy);
    if (!has_ids)
      for (mesh::MeshArrays& piece : files.tets) piece.point_ids.clear();
    const check::CheckReport report = check_everywhere(files);
    EXPECT_GT(count(report, has_ids ? "point_id_twice" : "duplicate_point"), 0) << to_json(report);
  }
}

TEST(CheckDefects, DuplicatePointInOnePiece)
{
  MeshFiles files = good_files();
  mesh::MeshArrays& piece = files.tets[1];
  const auto row = static_cast<std::size_t>(piece.cell_points[0]);
  const Vec3 position = point_at(std::span<const double>(piece.point_xyz), row);
  piece.cell_points[0] = add_point(piece, position, 64);
  const check::CheckReport report = check_everywhere(files);
  EXPECT_GT(count(report, "duplicate_point"), 0);
  EXPECT_TRUE(names(report, "duplicate_point",
                    {"piece 1", "(id 64)", "point " + std::to_string(row) + " "}));
}

TEST(CheckDefects, TwoIdsForOnePositionInDifferentPieces)
{
  MeshFiles files = good_files();
  const GlobalIndex id = shared_point(files.tets[1], files.tets[2]);
  files.tets[2].point_ids[row_of_point(files.tets[2], id)] = 64;
  const check::CheckReport report = check_everywhere(files);
  EXPECT_EQ(count(report, "duplicate_point"), 1) << to_json(report);
  EXPECT_TRUE(names(report, "duplicate_point",
                    {"piece 1", "piece 2", "(id 64)", "(id " + std::to_string(id) + ")"}));
  EXPECT_GT(count(report, "folded_boundary"), 0);
}

TEST(CheckDefects, UnusedPoint)
{
  MeshFiles files = good_files();
  add_point(files.tets[1], {0.3, 0.4, 0.6}, 64);
  const check::CheckReport report = check_everywhere(files);
  EXPECT_EQ(report.defects.size(), 1U) << to_json(report);
  EXPECT_TRUE(names(report, "unused_point", {"piece 1", "(id 64)"}));
  EXPECT_EQ(report.num_vertices, 64);
}

TEST(CheckDefects, HangingNodeAtASeam)
{
  // The tet at one edge of the seam is cut in two, its neighbours over the seam are not.
  MeshFiles files = slice(kuhn_cube(2), 2);
  files.boundary.clear();
  mesh::MeshArrays& piece = files.tets[0];
  const auto point = [&](LocalIndex row) {
    return point_at(std::span<const double>(piece.point_xyz), row);
  };
  const LocalIndex centre = add_point(piece, {0.5, 0.25, 0.25}, 27);
  const Vec3 a{0.5, 0.0, 0.0};
  const Vec3 b{0.5, 0.5, 0.5};
  const GlobalIndex num_tets = piece.num_cells();
  for (GlobalIndex t = 0; t < num_tets; ++t) {
    std::array<LocalIndex, 4> first{};
    std::array<LocalIndex, 4> second{};
    int num_ends = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      const LocalIndex row = piece.cell_points[4 * static_cast<std::size_t>(t) + i];
      first[i] = point(row) == a ? centre : row;
      second[i] = point(row) == b ? centre : row;
      if (first[i] != row || second[i] != row) ++num_ends;
    }
    if (num_ends < 2) continue;
    std::copy(first.begin(), first.end(), piece.cell_points.begin() + 4 * t);
    add_tet(piece, second, piece.num_cells() + 24);
  }
  ASSERT_GT(piece.num_cells(), num_tets);
  const check::CheckReport report = check_everywhere(files);
  EXPECT_NEAR(report.volume, 1.0, 1e-14);
  EXPECT_GT(count(report, "folded_boundary"), 0) << to_json(report);
  EXPECT_TRUE(names(report, "folded_boundary", {"of piece 0", "of piece 1"}));
  EXPECT_EQ(count(report, "non_positive_volume"), 0);
}

TEST(CheckDefects, MissingTetLeavesAHoleInTheIdsOfCells)
{
  MeshFiles files = good_files();
  remove_last_tet(files.tets[0]);
  const check::CheckReport report = check_everywhere(files);
  EXPECT_EQ(count(report, "cell_id_hole"), 1);
  EXPECT_TRUE(names(report, "cell_id_hole", {"id 53,"}));
}

TEST(CheckDefects, PositionsThatAreNotFinite)
{
  MeshFiles files = good_files();
  files.tets[2].point_xyz[3] = std::numeric_limits<double>::quiet_NaN();
  const check::CheckReport report = check_everywhere(files);
  EXPECT_TRUE(names(report, "non_finite_point", {"piece 2: point 1 "}));
  EXPECT_GT(count(report, "non_positive_volume"), 0);
  EXPECT_TRUE(std::isfinite(report.volume));
  EXPECT_TRUE(std::isfinite(report.quality.mean_ratio_mean));
}

TEST(CheckDefects, ConnectivityOutOfRangeOrNotDifferent)
{
  MeshFiles files = good_files();
  files.tets[0].cell_points[9] = static_cast<LocalIndex>(files.tets[0].num_points());
  files.tets[1].cell_points[5] = -1;
  files.tets[2].cell_points[1] = files.tets[2].cell_points[0];
  const check::CheckReport report = check_everywhere(files);
  EXPECT_EQ(count(report, "cell_points"), 3);
  EXPECT_TRUE(names(report, "cell_points", {"cell 2 (id 2) of piece 0"}));
  EXPECT_TRUE(names(report, "cell_points", {"cell 1 (id 55) of piece 1"}));
  EXPECT_TRUE(names(report, "cell_points", {"cell 0 (id 108) of piece 2"}));
}

TEST(CheckDefects, ArraysOfWrongLength)
{
  MeshFiles files = good_files();
  files.tets[0].cell_ints["attribute"].pop_back();
  files.tets[1].point_ids.push_back(7);
  files.tets[2].point_xyz.pop_back();
  const check::CheckReport report = check_everywhere(files);
  EXPECT_EQ(count(report, "arrays"), 3);
  EXPECT_TRUE(names(report, "arrays", {"piece 0", "\"attribute\""}));
  EXPECT_TRUE(names(report, "arrays", {"piece 1", "ids"}));
  EXPECT_TRUE(names(report, "arrays", {"piece 2", "coordinates"}));
}

TEST(CheckDefects, MeshWithoutTets)
{
  EXPECT_EQ(count(check_everywhere({}), "no_tets"), 1);
  MeshFiles files;
  files.tets.resize(3);
  EXPECT_EQ(count(check_everywhere(files), "no_tets"), 1);
}

TEST(CheckDefects, OnlyTheFirstOffendersAreNamedButAllAreCounted)
{
  MeshFiles files = good_files();
  for (mesh::MeshArrays& piece : files.tets)
    for (std::size_t c = 0; c < 54; ++c)
      std::swap(piece.cell_points[4 * c], piece.cell_points[4 * c + 1]);
  const check::CheckReport report = check_everywhere(files);
  EXPECT_EQ(count(report, "non_positive_volume"), 162);
  EXPECT_EQ(report.defects[0].offenders.size(), 10U);
  EXPECT_TRUE(names(report, "non_positive_volume", {"cell 9 (id 9) of piece 0"}));
}

}  // namespace
}  // namespace tessera::testing
