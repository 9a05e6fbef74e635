// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/viewer/surface.hpp"

#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "tessera/base/bytes.hpp"
#include "tessera/base/vec3.hpp"

#include "pipeline/stages/output/drawing_plan.hpp"
#include "support/decompositions.hpp"
#include "support/meshes.hpp"

namespace tessera::pipeline {
namespace {

// One regular tet whose id is 7, and the two of its sides on the points 0, 1.
mesh::MeshArrays regular_tet()
{
  return {.point_xyz = {1, 1, 1, 1, -1, -1, -1, 1, -1, -1, -1, 1},
          .cell_points = {0, 2, 1, 3},
          .point_ids = {10, 11, 12, 13},
          .cell_ids = {7}};
}

mesh::MeshArrays two_sides(GlobalIndex tet)
{
  return {.vertices_per_cell = 3,
          .point_xyz = {1, 1, 1, 1, -1, -1, -1, 1, -1, -1, -1, 1},
          .cell_points = {0, 1, 2, 0, 3, 1},
          .point_ids = {10, 11, 12, 13},
          .cell_ints = {{"patch", {4, 5}}, {"subdomain", {1, 1}}},
          .cell_longs = {{"tet", {tet, tet}}}};
}

TEST(SurfacePart, KnowsTheQualityOfTheTetBehind)
{
  const mesh::MeshArrays tets = regular_tet();
  const SurfacePart part = surface_part(0, two_sides(7), &tets);
  EXPECT_EQ(part.cells.at("quality"), (std::vector<std::uint32_t>{250, 250}));
  EXPECT_EQ(part.cells.at("face"), (std::vector<std::uint32_t>{4, 5}));
  EXPECT_EQ(part.cells.at("subdomain"), (std::vector<std::uint32_t>{1, 1}));
}

TEST(SurfacePart, SaysWhatItDoesNotKnow)
{
  const mesh::MeshArrays tets = regular_tet();
  const std::vector<std::uint32_t> unknown(2, kUnknownQuality);
  EXPECT_EQ(surface_part(0, two_sides(8), &tets).cells.at("quality"), unknown);
  EXPECT_EQ(surface_part(0, two_sides(7), nullptr).cells.at("quality"), unknown);
}

TEST(SurfacePart, FindsTetsWhoseIdsDoNotAscend)
{
  mesh::MeshArrays tets = regular_tet();
  tets.cell_ids = {9, 7, 8};
  tets.point_xyz[0] = 100.0;
  tets.point_xyz.insert(tets.point_xyz.end(), {1, 1, 1});
  tets.cell_points = {0, 2, 1, 3, 4, 2, 1, 3, 0, 2, 1, 3};
  const SurfacePart part = surface_part(0, two_sides(7), &tets);
  EXPECT_EQ(part.cells.at("quality").front(), 250U);
}

TEST(Surface, HasPointsOfPartsOnceWhateverTheirOrder)
{
  SurfacePart a = surface_part(0, two_sides(7), nullptr);
  SurfacePart b = surface_part(1, two_sides(7), nullptr);
  b.point_ids = {20, 11, 10, 21};
  for (std::size_t axis = 0; axis < 3; ++axis) std::swap(b.point_xyz[axis], b.point_xyz[6 + axis]);
  const Surface surface = joined({b, a});
  EXPECT_EQ(surface.point_xyz.size(), 3U * 6U);
  EXPECT_EQ(surface.num_triangles(), 4U);
  EXPECT_EQ(to_bytes(surface.corners), to_bytes(joined({a, b}).corners));
  EXPECT_EQ(surface.corners[0], 0);
  EXPECT_EQ(surface.corners[8], 0);  // Point 10 of the second part.
}

TEST(Surface, LeavesOutWhatNotAllPartsHave)
{
  SurfacePart a = surface_part(0, two_sides(7), nullptr);
  const SurfacePart b = surface_part(1, two_sides(7), nullptr);
  a.cells["layer"] = {0, 1};
  const Surface surface = joined({a, b});
  EXPECT_FALSE(surface.cells.contains("layer"));
  EXPECT_TRUE(surface.cells.contains("face"));
}

// The octants of a cube, each its own subdomain, as if they had been filled.
class SurfaceOfACube : public ::testing::Test {
 protected:
  SurfaceOfACube()
  {
    for (LocalIndex s = 0; s < 8; ++s) {
      run_.filled.pieces.push_back({.subdomain = s, .num_tets = 1000, .num_boundary = 100});
    }
  }

  [[nodiscard]] DrawingPlan plan() const
  {
    return plan_drawing(run_, cut_, MeshScene(cube_.vertex_xyz), subdomain::file_ranges(8, 0));
  }

  mesh::CoarseMesh cube_ = testing::kuhn_cube(4);
  mesh::Decomposition octants_ = testing::octants(cube_);
  subdomain::PartitionedMesh cut_{cube_, octants_, mesh::EdgeLevels(1)};
  RunResult run_{};
};

// Volume by the divergence theorem: positive only if triangles look outwards.
double enclosed(const Surface& surface)
{
  double volume = 0.0;
  const std::span<const double> xyz(surface.point_xyz);
  for (std::size_t t = 0; t < surface.num_triangles(); ++t) {
    const LocalIndex* const v = &surface.corners[3 * t];
    volume += dot(point_at(xyz, v[0]), cross(point_at(xyz, v[1]), point_at(xyz, v[2]))) / 6.0;
  }
  return volume;
}

TEST_F(SurfaceOfACube, OfCoarseTrianglesLooksOutwards)
{
  const Surface whole = coarse_surface(cut_, run_.filled.pieces);
  EXPECT_TRUE(whole.is_coarse);
  EXPECT_NEAR(enclosed(whole), 1.0, 1e-12);
  run_.filled.pieces.resize(1);
  const Surface part = coarse_surface(cut_, run_.filled.pieces);
  EXPECT_NEAR(enclosed(part), 1.0 / 8.0, 1e-12);
  const auto& faces = part.cells.at("face");
  EXPECT_EQ(*std::ranges::max_element(faces),
            static_cast<std::uint32_t>(cube_.num_patches()));  // Where the part ends.
}

TEST_F(SurfaceOfACube, IsThatOfTheFilesAsLongAsAPageHasRoom)
{
  const DrawingPlan fine = plan();
  EXPECT_FALSE(fine.is_coarse_surface);
  ASSERT_EQ(fine.files.size(), 8U);
  EXPECT_TRUE(std::ranges::all_of(fine.files, [](const FileToDraw& file) {
    return file.has_surface && file.has_boundary && file.has_quality;
  }));
  run_.filled.pieces[3].num_boundary = Surface::kMostTriangles;
  const DrawingPlan coarse = plan();
  EXPECT_TRUE(coarse.is_coarse_surface);
  EXPECT_FALSE(coarse.is_coarse_boundary);
  EXPECT_TRUE(std::ranges::none_of(coarse.files, &FileToDraw::has_surface));
}

TEST_F(SurfaceOfACube, OfSecondOrderHasFourTrianglesAFace)
{
  run_.filled.pieces[3].num_boundary = Surface::kMostTriangles / 3;
  EXPECT_FALSE(plan().is_coarse_surface);
  run_.resolved.output.order = 2;
  EXPECT_TRUE(plan().is_coarse_surface);
}

TEST_F(SurfaceOfACube, ReadsNoFilesOfTooManyTetsForTheirQuality)
{
  run_.filled.pieces[3].num_tets = 1'000'001;
  for (const FileToDraw& file : plan().files) {
    EXPECT_EQ(file.has_quality, file.number != 3);
    EXPECT_TRUE(file.has_surface);
  }
}

}  // namespace
}  // namespace tessera::pipeline
