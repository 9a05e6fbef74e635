// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/subdomain/measure_piece.hpp"

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "tessera/improve/seam_regions.hpp"

#include "support/filled_cube.hpp"

namespace tessera::subdomain {
namespace {

// Pieces that NETGEN made of four slabs, measured as if they had exchanged tets.
struct MeasureImprovedPiece : testing::FilledCube {
  [[nodiscard]] static PieceSummary measured(const mesh::Piece& piece, const PieceSummary& filled)
  {
    const improve::SeamRegions regions(body().skeleton, body().decomposition);
    const auto on_seam = improve::vertices_perhaps_on_seams(piece, regions);
    return measure_improved_part(improve::whole_piece(piece), on_seam, filled).summary;
  }
};

TEST_F(MeasureImprovedPiece, FindsWhatWasMeasuredWhenItWasFilled)
{
  for (const FilledPiece& filled : pieces()) {
    const PieceSummary& before = filled.result.summary;
    PieceSummary unknown;
    unknown.boundary_area = before.boundary_area;
    unknown.num_boundary = before.num_boundary;
    const PieceSummary after = measured(filled.piece, unknown);
    EXPECT_EQ(after.num_tets, before.num_tets);
    EXPECT_EQ(after.num_boundary, before.num_boundary);
    EXPECT_EQ(after.volume, before.volume);
    EXPECT_EQ(after.boundary_area, before.boundary_area) << "An exchange does not change it.";
    EXPECT_EQ(after.tets.min_mean_ratio, before.tets.min_mean_ratio);
    EXPECT_EQ(after.seam_tets.num_tets, before.seam_tets.num_tets);
    EXPECT_EQ(after.seam_tets.sum_mean_ratio, before.seam_tets.sum_mean_ratio);
    EXPECT_GT(before.seam_tets.num_tets, 0);
    EXPECT_LT(before.seam_tets.num_tets, before.num_tets);
  }
}

TEST_F(MeasureImprovedPiece, PatchesOfAllPiecesAreThoseOfTheCube)
{
  std::map<LocalIndex, double> areas;
  for (const FilledPiece& filled : pieces()) {
    GlobalIndex num_triangles = 0;
    for (const PatchArea& patch : filled.result.summary.patches) {
      areas[patch.patch] += patch.area;
      num_triangles += patch.num_triangles;
    }
    EXPECT_EQ(num_triangles, filled.result.summary.num_boundary);
  }
  ASSERT_EQ(areas.size(), 7U) << "Six sides, and the face between the materials.";
  for (const auto& [patch, area] : areas) EXPECT_NEAR(area, 1.0, 1e-12) << patch;
}

TEST_F(MeasureImprovedPiece, TheOrderOfSharedVerticesDoesNotMatter)
{
  mesh::Piece piece = pieces()[1].piece;
  const LocalIndex last = piece.num_skin_vertices() - 1;
  for (LocalIndex v = 0; v < last - v; ++v) {
    std::swap_ranges(&piece.vertex_xyz[3 * at(v)], &piece.vertex_xyz[3 * at(v)] + 3,
                     &piece.vertex_xyz[3 * at(last - v)]);
  }
  std::ranges::reverse(piece.skin_host);
  std::ranges::reverse(piece.skin_index);
  for (LocalIndex& v : piece.tet_vertices) v = v <= last ? last - v : v;
  const PieceSummary turned = measured(piece, {});
  EXPECT_EQ(turned.seam_tets.num_tets, pieces()[1].result.summary.seam_tets.num_tets);
  EXPECT_EQ(turned.surface, measured(pieces()[1].piece, {}).surface);
}

}  // namespace
}  // namespace tessera::subdomain
