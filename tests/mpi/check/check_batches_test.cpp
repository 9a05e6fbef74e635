// SPDX-License-Identifier: BSD-3-Clause
// Meshes of so many pieces that they are read in batches, of which only the front is remembered.
#include <algorithm>
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "support/box_pieces.hpp"

#include "check_everywhere.hpp"

namespace tessera::testing {
namespace {

constexpr int kLevels = 3;  // 512 pieces: sixteen batches.
constexpr GlobalIndex kCells = 8;

MeshFiles box_files()
{
  const BoxPieces box(kLevels, 1);
  MeshFiles files;
  for (LocalIndex piece = 0; piece < box.num_pieces(); ++piece) {
    files.tets.push_back(box.tets(piece));
    files.boundary.push_back(box.boundary(piece));
  }
  return files;
}

void expect_figures_of_the_box(const check::CheckReport& report)
{
  const GlobalIndex n = kCells;
  EXPECT_TRUE(report.conforms) << to_json(report);
  EXPECT_TRUE(report.matched_by_ids);
  EXPECT_EQ(report.num_tets, 6 * n * n * n);
  EXPECT_EQ(report.num_vertices, (n + 1) * (n + 1) * (n + 1));
  EXPECT_EQ(report.num_boundary_triangles, 12 * n * n);
  EXPECT_EQ(report.num_triangles, 12 * n * n * n + 6 * n * n);
  EXPECT_EQ(report.num_seam_triangles, 3 * 2 * n * n * (n - 1));
  EXPECT_EQ(report.euler_characteristic, 1);
  EXPECT_EQ(report.num_components, 1);
  EXPECT_EQ(report.num_boundary_components, 1);
  EXPECT_EQ(report.num_nonmanifold_edges, 0);
  EXPECT_NEAR(report.volume, 1.0, 1e-12);
  EXPECT_NEAR(report.boundary_area, 6.0, 1e-12);
  // A cell has a vertex that is no corner of the box, and that lies on a seam.
  EXPECT_EQ(report.seam_quality.num_tets, report.num_tets);
}

TEST(CheckBatches, BoxOfManyPiecesConforms)
{
  expect_figures_of_the_box(check_everywhere(box_files()));
}

TEST(CheckBatches, OrderOfPiecesDoesNotMatter)
{
  const MeshFiles files = box_files();
  MeshFiles shuffled;
  const auto num_pieces = files.tets.size();
  for (std::size_t p = 0; p < num_pieces; ++p) {
    // Steps that have no factor with 512: neighbours get far apart, and boundary pieces from tets.
    shuffled.tets.push_back(files.tets[(p * 197 + 5) % num_pieces]);
    shuffled.boundary.push_back(files.boundary[(p * 331 + 77) % num_pieces]);
  }
  expect_figures_of_the_box(check_everywhere(shuffled));
}

TEST(CheckBatches, BoundaryInOneFile)
{
  MeshFiles files = box_files();
  files.boundary = merge(files, {0, files.tets.size()}).boundary;
  std::vector<std::int32_t>& subdomain = files.boundary[0].cell_ints["subdomain"];
  EXPECT_EQ(subdomain.back(), 511);
  expect_figures_of_the_box(check_everywhere(files));
}

TEST(CheckBatches, BoundaryIsReadForEveryFewOpenTriangles)
{
  const MeshFiles files = box_files();
  const check::PieceSource tets = source_of(files.tets);
  check::PieceSource boundary = source_of(files.boundary);
  LocalIndex num_reads = 0;
  boundary.read = [&, read = boundary.read](LocalIndex piece) {
    ++num_reads;
    return read(piece);
  };
  const comm::Communicator self(MPI_COMM_SELF);
  expect_figures_of_the_box(check::check_mesh(tets, &boundary, self, {}, kTightLimits));
  const auto num_open = static_cast<LocalIndex>(12 * kCells * kCells);
  const LocalIndex num_readings = 1 + num_open / 50;
  // Once beside the tets, once for its vertices.
  EXPECT_EQ(num_reads, (2 + num_readings) * boundary.num_pieces);
}

TEST(CheckBatches, IdsOfCellsThatDoNotAscend)
{
  MeshFiles files = box_files();
  const auto shuffle = [](std::vector<GlobalIndex>& ids) {
    // The factor has no factor with the number of tets, so that ids stay dense.
    for (GlobalIndex& id : ids) id = (5 * id + 1) % (6 * kCells * kCells * kCells);
  };
  for (mesh::MeshArrays& piece : files.tets) shuffle(piece.cell_ids);
  for (mesh::MeshArrays& piece : files.boundary) shuffle(piece.cell_longs["tet"]);
  expect_figures_of_the_box(check_everywhere(files));

  GlobalIndex& named = files.boundary.back().cell_longs.at("tet").back();
  const std::string id = std::to_string(named);
  named = (named + 1) % (6 * kCells * kCells * kCells);
  const check::CheckReport report = check_everywhere(files);
  EXPECT_EQ(count(report, "boundary_tet"), 1);
  EXPECT_TRUE(names(report, "boundary_tet", {"(id " + id + ")"})) << to_json(report);
}

TEST(CheckBatches, WithoutIdsAllIsFoundByPosition)
{
  MeshFiles files = box_files();
  for (auto* pieces : {&files.tets, &files.boundary})
    for (mesh::MeshArrays& piece : *pieces) piece.point_ids.clear();
  const check::CheckReport report = check_everywhere(files);
  EXPECT_TRUE(report.conforms) << to_json(report);
  EXPECT_FALSE(report.matched_by_ids);
  EXPECT_EQ(report.euler_characteristic, 1);
  EXPECT_EQ(report.seam_quality.num_tets, report.num_tets);
}

// Copies the first tet of a piece into another piece, with an id of its own.
void copy_tet(const mesh::MeshArrays& from, mesh::MeshArrays& to, GlobalIndex id)
{
  for (std::size_t corner = 0; corner < 4; ++corner) {
    const auto row = static_cast<std::size_t>(from.cell_points[corner]);
    const auto found = std::find(to.point_ids.begin(), to.point_ids.end(), from.point_ids[row]);
    to.cell_points.push_back(static_cast<LocalIndex>(found - to.point_ids.begin()));
    if (found != to.point_ids.end()) continue;
    to.point_ids.push_back(from.point_ids[row]);
    to.point_xyz.insert(to.point_xyz.end(), &from.point_xyz[3 * row], &from.point_xyz[3 * row] + 3);
  }
  to.cell_ids.push_back(id);
  to.cell_ints["attribute"].push_back(1);
  to.cell_ints["subdomain"].push_back(to.cell_ints["subdomain"][0]);
}

TEST(CheckBatches, ThirdTetAtATriangleThatWasDoneWithIsNoticed)
{
  MeshFiles files = box_files();
  // Piece 7 lies inside the first batch but for its corner; piece 511 comes in the last one.
  copy_tet(files.tets[7], files.tets[511], 6 * kCells * kCells * kCells);
  const check::CheckReport report = check_everywhere(files);
  EXPECT_GT(count(report, "triangle"), 0) << to_json(report);
  EXPECT_TRUE(names(report, "triangle", {"more than two tets", "piece 511"}));
}

TEST(CheckBatches, PointsOfDistantPiecesAreCompared)
{
  MeshFiles files = box_files();
  // The centre, which eight pieces of different batches share.
  mesh::MeshArrays* last = nullptr;
  std::size_t row = 0;
  for (mesh::MeshArrays& piece : files.tets) {
    for (std::size_t p = 0; p < piece.point_ids.size(); ++p) {
      if (point_at(std::span<const double>(piece.point_xyz), p) != Vec3{0.5, 0.5, 0.5}) continue;
      last = &piece;
      row = p;
    }
  }
  last->point_xyz[3 * row] = std::nextafter(0.5, 1.0);
  const check::CheckReport report = check_everywhere(files);
  EXPECT_EQ(report.defects.size(), 1U) << to_json(report);
  EXPECT_EQ(count(report, "point_position"), 1);
}

TEST(CheckBatches, MissingPieceIsSeenAsOpenSeam)
{
  MeshFiles files = box_files();
  files.tets.erase(files.tets.begin() + 7);
  const check::CheckReport report = check_everywhere(files, {.is_partial = true});
  EXPECT_TRUE(report.conforms) << to_json(report);
  EXPECT_EQ(report.num_open_seam_triangles, 12);
  EXPECT_EQ(report.num_boundary_triangles, 12 * kCells * kCells);
  EXPECT_EQ(report.num_boundary_components, 2);
}

TEST(CheckBatches, EdgeThatAFileTouchesTwiceIsCountedOnce)
{
  // The box in eight: quarters around an axis, two cubes each. Opposite quarters go into one file,
  // so at the edges of the axis each of the others has two triangles towards it, and it has four.
  const BoxPieces box(1, 2);
  MeshFiles files;
  for (const LocalIndex piece : {0, 4, 3, 7, 1, 5, 2, 6}) {
    files.tets.push_back(box.tets(piece));
    files.boundary.push_back(box.boundary(piece));
  }
  const check::CheckReport report = check_everywhere(merge(files, {0, 4, 6, 8}));
  EXPECT_TRUE(report.conforms) << to_json(report);
  EXPECT_EQ(report.euler_characteristic, 1);
}

}  // namespace
}  // namespace tessera::testing
