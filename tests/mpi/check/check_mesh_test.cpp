// SPDX-License-Identifier: BSD-3-Clause
// What the checker says of meshes without a defect.
#include <cmath>

#include <gtest/gtest.h>

#include "tessera/base/error.hpp"

#include "support/meshes.hpp"

#include "check_everywhere.hpp"

namespace tessera::testing {
namespace {

TEST(CheckMesh, CubeInSlicesConforms)
{
  const check::CheckReport report = check_everywhere(slice(kuhn_cube(4), 4));

  EXPECT_TRUE(report.conforms) << to_json(report);
  EXPECT_TRUE(report.has_global_ids);
  EXPECT_TRUE(report.matched_by_ids);
  EXPECT_EQ(report.num_tets, 6 * 64);
  EXPECT_EQ(report.num_vertices, 125);
  EXPECT_EQ(report.num_boundary_triangles, 6 * 2 * 16);
  EXPECT_EQ(report.num_triangles, (4 * 6 * 64 + 6 * 2 * 16) / 2);
  EXPECT_EQ(report.num_seam_triangles, 3 * 2 * 16);
  EXPECT_EQ(report.num_interface_triangles, 0);
  EXPECT_EQ(report.num_open_seam_triangles, 0);
  EXPECT_EQ(report.num_nonmanifold_edges, 0);
  EXPECT_EQ(report.euler_characteristic, 1);
  EXPECT_EQ(report.num_components, 1);
  EXPECT_EQ(report.num_boundary_components, 1);
  EXPECT_NEAR(report.volume, 1.0, 1e-14);
  EXPECT_NEAR(report.boundary_area, 6.0, 1e-14);
}

TEST(CheckMesh, FiguresDoNotDependOnHowTheMeshIsCut)
{
  const check::CheckReport one = check_everywhere(slice(kuhn_cube(4), 1));
  const check::CheckReport four = check_everywhere(slice(kuhn_cube(4), 4));
  EXPECT_TRUE(one.conforms) << to_json(one);
  EXPECT_EQ(one.num_vertices, four.num_vertices);
  EXPECT_EQ(one.num_edges, four.num_edges);
  EXPECT_EQ(one.num_triangles, four.num_triangles);
  EXPECT_EQ(one.num_components, four.num_components);
  EXPECT_EQ(one.quality.mean_ratio_histogram, four.quality.mean_ratio_histogram);
  EXPECT_EQ(one.num_seam_triangles, 0);
  EXPECT_EQ(one.seam_quality.num_tets, 0);
}

TEST(CheckMesh, KuhnTetsHaveTheirKnownQuality)
{
  const check::CheckReport report = check_everywhere(slice(kuhn_cube(4), 2));
  // Edges 1, 1, 1, sqrt 2, sqrt 2, sqrt 3 and volume 1/6.
  const double mean_ratio = 12.0 * std::cbrt(0.25) / 10.0;
  EXPECT_NEAR(report.quality.mean_ratio_min, mean_ratio, 1e-12);
  EXPECT_NEAR(report.quality.mean_ratio_mean, mean_ratio, 1e-12);
  EXPECT_NEAR(report.quality.mean_ratio_p01, mean_ratio, 1.0 / 2000);
  EXPECT_NEAR(report.quality.min_dihedral_deg, 45.0, 1e-6);
  EXPECT_NEAR(report.quality.max_dihedral_deg, 90.0, 1e-6);
  EXPECT_NEAR(report.edge_length.p01, 0.25, 0.25 * 0.01);
  EXPECT_NEAR(report.edge_length.p99, 0.25 * std::sqrt(3.0), 0.25 * 0.02);
  // Of the four layers of cells, the inner two touch the seam at x = 1/2 with every tet.
  EXPECT_EQ(report.seam_quality.num_tets, 2 * 6 * 16);
}

TEST(CheckMesh, InterfacesBetweenMaterialsAreNoSeams)
{
  const check::CheckReport two = check_everywhere(slice(two_material_cube(4), 2));
  EXPECT_TRUE(two.conforms) << to_json(two);
  EXPECT_EQ(two.num_interface_triangles, 2 * 16);
  EXPECT_EQ(two.num_seam_triangles, 0);
  EXPECT_EQ(two.seam_quality.num_tets, 0);

  const check::CheckReport one = check_everywhere(slice(two_material_cube(4), 1));
  EXPECT_TRUE(one.conforms) << to_json(one);
  EXPECT_EQ(one.num_interface_triangles, 2 * 16);
}

TEST(CheckMesh, DigestChangesWithMaterialIdAndOneBitOfAPosition)
{
  const MeshFiles files = slice(kuhn_cube(2), 2);
  const check::CheckReport report = check_everywhere(files);
  EXPECT_TRUE(report.has_digest);

  MeshFiles other = files;
  other.tets[1].cell_ints["attribute"][3] = 2;
  EXPECT_NE(check_everywhere(other).digest, report.digest);

  other = files;
  std::swap(other.tets[0].point_ids[0], other.tets[0].point_ids[1]);
  EXPECT_NE(check_everywhere(other).digest, report.digest);

  other = files;
  double& x = other.tets[1].point_xyz.back();
  x = std::nextafter(x, 2.0);
  EXPECT_NE(check_everywhere(other).digest, report.digest);
}

TEST(CheckMesh, DigestDoesNotDependOnTheOrderOfCells)
{
  MeshFiles files = slice(kuhn_cube(2), 2);
  const check::CheckReport report = check_everywhere(files);
  mesh::MeshArrays& piece = files.tets[0];
  std::swap_ranges(piece.cell_points.begin(), piece.cell_points.begin() + 4,
                   piece.cell_points.begin() + 4);
  std::swap(piece.cell_ids[0], piece.cell_ids[1]);
  const check::CheckReport swapped = check_everywhere(files);
  EXPECT_EQ(swapped.digest, report.digest);
  EXPECT_TRUE(swapped.conforms) << to_json(swapped);
}

TEST(CheckMesh, MeshWithoutIdsIsMatchedByPosition)
{
  MeshFiles files = slice(kuhn_cube(4), 4);
  files.boundary.clear();
  for (mesh::MeshArrays& piece : files.tets) {
    piece.point_ids.clear();
    piece.cell_ids.clear();
    piece.cell_ints.clear();
  }
  const check::CheckReport report = check_everywhere(files);
  EXPECT_TRUE(report.conforms) << to_json(report);
  EXPECT_FALSE(report.has_global_ids);
  EXPECT_FALSE(report.has_digest);
  EXPECT_FALSE(report.matched_by_ids);
  EXPECT_FALSE(report.notes.empty());
  EXPECT_EQ(report.num_vertices, 125);
  EXPECT_EQ(report.num_seam_triangles, 3 * 2 * 16);
  EXPECT_EQ(report.euler_characteristic, 1);
}

TEST(CheckMesh, MeshOfWhichOnePieceLacksIdsIsMatchedByPosition)
{
  MeshFiles files = slice(kuhn_cube(4), 4);
  files.tets[2].point_ids.clear();
  const check::CheckReport report = check_everywhere(files);
  EXPECT_TRUE(report.conforms) << to_json(report);
  EXPECT_FALSE(report.matched_by_ids);
  EXPECT_EQ(report.num_vertices, 125);
}

TEST(CheckMesh, IdsThatNumberEachPieceAloneAreReportedAndPointsMatchedByPosition)
{
  MeshFiles files = slice(kuhn_cube(4), 4);
  files.boundary.clear();
  for (mesh::MeshArrays& piece : files.tets)
    for (std::size_t p = 0; p < piece.point_ids.size(); ++p)
      piece.point_ids[p] = static_cast<GlobalIndex>(p);
  const check::CheckReport report = check_everywhere(files);
  EXPECT_FALSE(report.matched_by_ids);
  EXPECT_EQ(report.num_vertices, 125);
  EXPECT_EQ(report.num_boundary_triangles, 6 * 2 * 16);
  EXPECT_GT(count(report, "point_position") + count(report, "point_id_twice"), 0);
}

TEST(CheckMesh, ComponentsAreCountedAcrossPieces)
{
  // Without its second slice the cube is two bodies.
  MeshFiles files = slice(kuhn_cube(4), 4);
  files.boundary.clear();
  files.tets[1] = {};
  const check::CheckReport report = check_everywhere(files);
  EXPECT_EQ(report.num_components, 2);
  EXPECT_EQ(report.num_boundary_components, 2);
  EXPECT_EQ(report.euler_characteristic, 2);
}

TEST(CheckMesh, BodiesThatTouchInAnEdgeHaveANonmanifoldEdge)
{
  mesh::CoarseMesh cube = kuhn_cube(2);
  std::vector<LocalIndex> kept;
  for (LocalIndex t = 0; t < cube.num_tets(); ++t) {
    Vec3 centre{};
    for (const LocalIndex v : cube.tet(t)) centre = centre + 0.25 * cube.position(v);
    const bool is_on_diagonal = (centre[0] < 0.5) == (centre[1] < 0.5);
    if (is_on_diagonal && centre[2] < 0.5)
      kept.insert(kept.end(), cube.tet(t).begin(), cube.tet(t).end());
  }
  cube.tet_vertices = kept;
  cube.tet_material.resize(kept.size() / 4);
  const check::CheckReport report = check_everywhere(slice(cube, 2));
  EXPECT_TRUE(report.conforms) << to_json(report);
  EXPECT_EQ(report.num_nonmanifold_edges, 1);
  EXPECT_EQ(report.num_components, 2);
}

TEST(CheckMesh, UnreadablePieceIsAnErrorOnAllRanks)
{
  const MeshFiles files = slice(kuhn_cube(2), 2);
  check::PieceSource tets = source_of(files.tets);
  tets.read = [read = tets.read](LocalIndex piece) {
    if (piece == 1) throw InputError("no such file");
    return read(piece);
  };
  const comm::Communicator world(MPI_COMM_WORLD);
  EXPECT_THROW(static_cast<void>(check::check_mesh(tets, nullptr, world)), InputError);
}

}  // namespace
}  // namespace tessera::testing
