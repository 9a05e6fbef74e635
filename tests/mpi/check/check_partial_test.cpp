// SPDX-License-Identifier: BSD-3-Clause
// Meshes of which only some pieces were made, with the ids that a very large mesh would have.
#include <cmath>

#include <gtest/gtest.h>

#include "support/meshes.hpp"

#include "check_everywhere.hpp"

namespace tessera::testing {
namespace {

constexpr check::CheckOptions kPartial{.is_partial = true};
constexpr int kCells = 4;
constexpr GlobalIndex kSeamTriangles = 2 * kCells * kCells;  // Of one seam.

void shift(std::vector<GlobalIndex>& ids, GlobalIndex first, GlobalIndex step)
{
  for (GlobalIndex& id : ids) id = first + step * id;
}

// Some slices of a cube cut into four; its ids begin at `first` and stand `step` apart.
MeshFiles some_slices(const std::vector<std::size_t>& kept, GlobalIndex first, GlobalIndex step)
{
  const MeshFiles all = merge(slice(kuhn_cube(kCells), 4), {0, 1, 2, 3, 4});
  MeshFiles files;
  for (const std::size_t p : kept) {
    mesh::MeshArrays& tets = files.tets.emplace_back(all.tets[p]);
    mesh::MeshArrays& boundary = files.boundary.emplace_back(all.boundary[p]);
    shift(tets.point_ids, first, step);
    shift(tets.cell_ids, first, step);
    shift(boundary.point_ids, first, step);
    shift(boundary.cell_longs["tet"], first, step);
  }
  return files;
}

TEST(CheckPartial, NeighbouringPiecesConformAndOpenSeamsAreCounted)
{
  for (const GlobalIndex first :
       {GlobalIndex{0}, GlobalIndex{100'000'000'000}, GlobalIndex{1} << 60}) {
    const check::CheckReport report = check_everywhere(some_slices({1, 2}, first, 1), kPartial);
    EXPECT_TRUE(report.conforms) << to_json(report);
    EXPECT_TRUE(report.is_partial);
    EXPECT_TRUE(report.matched_by_ids);
    EXPECT_EQ(report.num_open_seam_triangles, 2 * kSeamTriangles);
    EXPECT_EQ(report.num_seam_triangles, kSeamTriangles);
    EXPECT_EQ(report.num_boundary_triangles, 2 * 4 * 2 * kCells);
    EXPECT_NEAR(report.boundary_area, 2.0, 1e-14);
    EXPECT_EQ(report.euler_characteristic, 1);
    EXPECT_EQ(report.num_components, 1);
    ASSERT_EQ(report.subdomains.size(), 2U);
    EXPECT_EQ(report.subdomains[1].id, 2);
    // The open seams are seams of the whole mesh.
    EXPECT_EQ(report.seam_quality.num_tets, report.num_tets);
  }
}

TEST(CheckPartial, IdsThatDifferOnlyInHighBitsAreDifferent)
{
  const MeshFiles files = some_slices({1, 2}, 7, GlobalIndex{1} << 53);
  const check::CheckReport report = check_everywhere(files, kPartial);
  EXPECT_TRUE(report.conforms) << to_json(report);
  EXPECT_TRUE(report.matched_by_ids);
  EXPECT_EQ(report.euler_characteristic, 1);
}

TEST(CheckPartial, PiecesThatDoNotTouch)
{
  const check::CheckReport report =
      check_everywhere(some_slices({0, 3}, 100'000'000'000, 3), kPartial);
  EXPECT_TRUE(report.conforms) << to_json(report);
  EXPECT_EQ(report.num_open_seam_triangles, 2 * kSeamTriangles);
  EXPECT_EQ(report.num_seam_triangles, 0);
  EXPECT_EQ(report.num_components, 2);
}

TEST(CheckPartial, CompleteMeshHasNoOpenSeam)
{
  const check::CheckReport report = check_everywhere(some_slices({0, 1, 2, 3}, 0, 1), kPartial);
  EXPECT_TRUE(report.conforms) << to_json(report);
  EXPECT_EQ(report.num_open_seam_triangles, 0);
}

TEST(CheckPartial, IsRefusedWithAHintUnlessAskedFor)
{
  const MeshFiles files = some_slices({1, 2}, 100'000'000'000, 1);
  const check::CheckReport report = check_everywhere(files);
  EXPECT_FALSE(report.conforms);
  EXPECT_FALSE(report.is_partial);
  EXPECT_EQ(count(report, "boundary_missing"), 2 * kSeamTriangles);
  // The slices' own ids begin behind those of slice 0 but for the points they share.
  EXPECT_GE(count(report, "cell_id_hole"), 100'000'000'000);
  ASSERT_FALSE(report.notes.empty());
  EXPECT_NE(report.notes.back().find("--partial"), std::string::npos);
}

TEST(CheckPartial, NoHintWhereItWouldNotHelp)
{
  MeshFiles files = some_slices({1, 2}, 100'000'000'000, 1);
  std::swap(files.tets[1].cell_points[4 * 7], files.tets[1].cell_points[4 * 7 + 1]);
  for (const std::string& note : check_everywhere(files).notes)
    EXPECT_EQ(note.find("--partial"), std::string::npos) << note;
}

TEST(CheckPartial, SharedPointMovedByOneBit)
{
  MeshFiles files = some_slices({1, 2}, 100'000'000'000, 5);
  const GlobalIndex id = shared_point(files.tets[0], files.tets[1]);
  double& y = files.tets[1].point_xyz[3 * row_of_point(files.tets[1], id) + 1];
  y = std::nextafter(y, 2.0);
  const check::CheckReport report = check_everywhere(files, kPartial);
  EXPECT_EQ(count(report, "point_position"), 1) << to_json(report);
  EXPECT_TRUE(names(report, "point_position", {"id " + std::to_string(id) + ")", "piece 1"}));
}

TEST(CheckPartial, TwoIdsForOnePosition)
{
  MeshFiles files = some_slices({1, 2}, 100'000'000'000, 5);
  const GlobalIndex id = shared_point(files.tets[0], files.tets[1]);
  // Equal to the right id in the low 32 bits.
  const GlobalIndex wrong = id + (GlobalIndex{1} << 32);
  files.tets[1].point_ids[row_of_point(files.tets[1], id)] = wrong;
  const check::CheckReport report = check_everywhere(files, kPartial);
  EXPECT_TRUE(names(report, "duplicate_point", {std::to_string(id), std::to_string(wrong)}))
      << to_json(report);
}

TEST(CheckPartial, CellIdTwice)
{
  MeshFiles files = some_slices({0, 3}, 100'000'000'000, 1);
  files.tets[1].cell_ids[0] = files.tets[0].cell_ids[3];
  const check::CheckReport report = check_everywhere(files, kPartial);
  EXPECT_EQ(count(report, "cell_id_twice"), 1) << to_json(report);
  EXPECT_TRUE(names(report, "cell_id_twice", {"cell id 100000000003 ", "piece 0 1"}));
}

TEST(CheckPartial, BoundaryTriangleThatNamesATetWithTheSameLowBits)
{
  MeshFiles files = some_slices({1, 2}, 100'000'000'000, 1);
  files.boundary[1].cell_longs["tet"][2] += GlobalIndex{1} << 32;
  const check::CheckReport report = check_everywhere(files, kPartial);
  EXPECT_EQ(report.defects.size(), 1U) << to_json(report);
  EXPECT_EQ(count(report, "boundary_tet"), 1);
}

TEST(CheckPartial, BoundaryTriangleOfAPieceThatIsNotThere)
{
  MeshFiles files = some_slices({1, 2}, 100'000'000'000, 1);
  files.boundary.push_back(some_slices({3}, 100'000'000'000, 1).boundary[0]);
  const check::CheckReport report = check_everywhere(files, kPartial);
  EXPECT_EQ(count(report, "boundary_extra"), files.boundary.back().num_cells()) << to_json(report);
}

TEST(CheckPartial, FlippedTet)
{
  MeshFiles files = some_slices({1, 2}, 100'000'000'000, 1);
  std::swap(files.tets[1].cell_points[4 * 7], files.tets[1].cell_points[4 * 7 + 1]);
  const check::CheckReport report = check_everywhere(files, kPartial);
  EXPECT_EQ(count(report, "non_positive_volume"), 1) << to_json(report);
}

}  // namespace
}  // namespace tessera::testing
