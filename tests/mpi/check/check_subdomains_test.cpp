// SPDX-License-Identifier: BSD-3-Clause
// Files that hold several subdomains each: what is said of the mesh does not depend on the files.
#include <gtest/gtest.h>

#include "support/meshes.hpp"

#include "check_everywhere.hpp"

namespace tessera::testing {
namespace {

constexpr std::size_t kNumSubdomains = 6;

// Six slices of two materials, three each; the interface lies between slices 2 and 3.
MeshFiles slices() { return slice(two_material_cube(6), static_cast<int>(kNumSubdomains)); }

void expect_same(const check::QualityFigures& a, const check::QualityFigures& b)
{
  EXPECT_EQ(a.num_tets, b.num_tets);
  EXPECT_EQ(a.min_dihedral_deg, b.min_dihedral_deg);
  EXPECT_EQ(a.max_dihedral_deg, b.max_dihedral_deg);
  EXPECT_EQ(a.mean_ratio_min, b.mean_ratio_min);
  EXPECT_EQ(a.mean_ratio_mean, b.mean_ratio_mean);
  EXPECT_EQ(a.mean_ratio_histogram, b.mean_ratio_histogram);
}

void expect_same(const check::CheckReport& a, const check::CheckReport& b)
{
  EXPECT_TRUE(b.conforms) << to_json(b);
  EXPECT_EQ(a.num_vertices, b.num_vertices);
  EXPECT_EQ(a.num_edges, b.num_edges);
  EXPECT_EQ(a.num_triangles, b.num_triangles);
  EXPECT_EQ(a.num_boundary_triangles, b.num_boundary_triangles);
  EXPECT_EQ(a.num_seam_triangles, b.num_seam_triangles);
  EXPECT_EQ(a.num_interface_triangles, b.num_interface_triangles);
  EXPECT_EQ(a.euler_characteristic, b.euler_characteristic);
  EXPECT_EQ(a.num_components, b.num_components);
  EXPECT_EQ(a.num_boundary_components, b.num_boundary_components);
  EXPECT_EQ(a.digest, b.digest);
  EXPECT_EQ(a.volume, b.volume);
  EXPECT_NEAR(a.boundary_area, b.boundary_area, 1e-12);
  expect_same(a.quality, b.quality);
  expect_same(a.seam_quality, b.seam_quality);
  EXPECT_EQ(a.edge_length.p01, b.edge_length.p01);
  EXPECT_EQ(a.edge_length.median, b.edge_length.median);
  EXPECT_EQ(a.edge_length.p99, b.edge_length.p99);
  ASSERT_EQ(a.subdomains.size(), b.subdomains.size());
  for (std::size_t s = 0; s < a.subdomains.size(); ++s) {
    EXPECT_EQ(a.subdomains[s].id, b.subdomains[s].id);
    EXPECT_EQ(a.subdomains[s].num_tets, b.subdomains[s].num_tets);
    EXPECT_EQ(a.subdomains[s].volume, b.subdomains[s].volume);
    EXPECT_EQ(a.subdomains[s].digest, b.subdomains[s].digest);
  }
}

TEST(CheckSubdomains, ReportIsTheSameForAnyNumberOfFiles)
{
  const check::CheckReport report = check_everywhere(slices());
  EXPECT_TRUE(report.conforms) << to_json(report);
  EXPECT_EQ(report.num_seam_triangles, 4 * 2 * 36);
  EXPECT_EQ(report.num_interface_triangles, 2 * 36);
  EXPECT_EQ(report.subdomains.size(), kNumSubdomains);
  // The two seams of a material lie one cell apart and one from its ends: all tets touch one.
  EXPECT_EQ(report.seam_quality.num_tets, report.num_tets);

  for (const std::vector<std::size_t>& first :
       {std::vector<std::size_t>{0, 1, 2, 3, 4, 5, 6}, {0, 2, 4, 6}, {0, 1, 5, 6}, {0, 6}})
    expect_same(report, check_everywhere(merge(slices(), first)));
}

TEST(CheckSubdomains, TetsThatTouchASeamOfTheOtherMaterialAreSeamTets)
{
  // Slices 0 to 2 become one subdomain: its tets at the interface touch no seam of their own.
  MeshFiles files = merge(slices(), {0, 3, 4, 5, 6});
  files.tets[0].cell_ints["subdomain"].assign(files.tets[0].cell_ids.size(), 0);
  for (std::int32_t& subdomain : files.boundary[0].cell_ints["subdomain"]) subdomain = 0;
  const check::CheckReport report = check_everywhere(files);
  EXPECT_TRUE(report.conforms) << to_json(report);
  EXPECT_EQ(report.num_seam_triangles, 2 * 2 * 36);
  EXPECT_EQ(report.seam_quality.num_tets, report.num_tets / 2);
}

TEST(CheckSubdomains, SubdomainInTwoFilesHasNoSeamBetweenThem)
{
  MeshFiles files = slice(kuhn_cube(4), 4);
  for (std::size_t p = 0; p < files.tets.size(); ++p) {
    const auto subdomain = static_cast<std::int32_t>(p / 2 + 7);
    files.tets[p].cell_ints["subdomain"].assign(files.tets[p].cell_ids.size(), subdomain);
    for (std::int32_t& named : files.boundary[p].cell_ints["subdomain"]) named = subdomain;
  }
  const check::CheckReport report = check_everywhere(files);
  EXPECT_TRUE(report.conforms) << to_json(report);
  EXPECT_EQ(report.num_seam_triangles, 2 * 16);
  ASSERT_EQ(report.subdomains.size(), 2U);
  EXPECT_EQ(report.subdomains[0].id, 7);
  EXPECT_EQ(report.subdomains[0].num_tets, report.num_tets / 2);
}

TEST(CheckSubdomains, BoundaryTriangleThatNamesAnotherSubdomainOfItsFile)
{
  MeshFiles files = merge(slices(), {0, 3, 6});
  files.boundary[1].cell_ints["subdomain"][0] = 4;
  const check::CheckReport report = check_everywhere(files);
  EXPECT_EQ(report.defects.size(), 1U) << to_json(report);
  EXPECT_TRUE(
      names(report, "boundary_subdomain", {"triangle 0 of boundary piece 1", "names subdomain 4"}));
}

TEST(CheckSubdomains, SeamInsideAFileIsNoBoundary)
{
  MeshFiles files = merge(slices(), {0, 6});
  mesh::MeshArrays& tets = files.tets[0];
  for (std::int32_t& material : tets.cell_ints["attribute"]) material = 1;
  const check::CheckReport report = check_everywhere(files);
  EXPECT_EQ(count(report, "boundary_extra"), 2 * 36) << to_json(report);
}

}  // namespace
}  // namespace tessera::testing
