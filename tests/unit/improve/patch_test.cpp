// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/improve/patch.hpp"

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tessera/base/error.hpp"

#include "support/bodies.hpp"
#include "support/decompositions.hpp"
#include "support/meshes.hpp"
#include "support/piece_sets.hpp"

#include "test_optimizers.hpp"

namespace tessera::improve {
namespace {

// Two halves of a cube, and the patch of the seam between them.
struct PatchOfTwoSlabs : ::testing::Test {
  const testing::Body body{testing::kuhn_cube(4), testing::slabs(testing::kuhn_cube(4), 2)};
  const Regions regions{body.skeleton, body.decomposition};
  const std::vector<mesh::Piece> pieces = testing::coarse_pieces(body);
  const std::vector<std::vector<LocalIndex>> labels{label_tets(pieces[0], regions, 0, 1),
                                                    label_tets(pieces[1], regions, 0, 1)};
  Patch patch = make();

  [[nodiscard]] Patch make() const
  {
    const std::vector<LabelledPiece> around{{pieces[0], labels[0]}, {pieces[1], labels[1]}};
    return improve_region(extract_region(around, regions, 0), testing::FlippingOptimizer(), {},
                          testing::always_better())
        .patch;
  }
};

TEST_F(PatchOfTwoSlabs, IsTheSameAfterATripThroughBytes)
{
  EXPECT_EQ(patch_from_bytes(to_bytes(patch)), patch);
}

TEST_F(PatchOfTwoSlabs, CutOffBytesAreRefused)
{
  Bytes bytes = to_bytes(patch);
  bytes.pop_back();
  EXPECT_THROW(static_cast<void>(patch_from_bytes(bytes)), InputError);
}

TEST_F(PatchOfTwoSlabs, PutsTheTetsThatStayFirstAndInOrder)
{
  for (std::size_t s = 0; s < 2; ++s) {
    const mesh::Piece improved = apply_patches(pieces[s], labels[s], {&patch, 1});
    LocalIndex next = 0;
    for (LocalIndex t = 0; t < pieces[s].num_tets(); ++t) {
      if (labels[s][at(t)] == 0) continue;
      EXPECT_EQ(improved.corners(next++), pieces[s].corners(t));
    }
    EXPECT_EQ(improved.num_tets(), next + patch.tet_offsets[s + 1] - patch.tet_offsets[s]);
    EXPECT_EQ(improved.boundary_patch, pieces[s].boundary_patch);
  }
}

TEST_F(PatchOfTwoSlabs, GivesSharedVerticesTheRegionsUnit)
{
  ASSERT_GT(patch.num_shared, 0);
  for (std::size_t s = 0; s < 2; ++s) {
    const mesh::Piece improved = apply_patches(pieces[s], labels[s], {&patch, 1});
    std::vector<char> is_found(at(patch.num_shared), 0);
    for (LocalIndex v = 0; v < improved.num_skin_vertices(); ++v) {
      if (improved.skin_unit[at(v)] == regions.unit_of(0)) {
        is_found[at(improved.skin_index[at(v)])] = 1;
      }
    }
    EXPECT_EQ(is_found, std::vector<char>(at(patch.num_shared), 1));
  }
}

TEST_F(PatchOfTwoSlabs, NoPatchChangesNothing)
{
  EXPECT_EQ(mesh::to_bytes(apply_patches(pieces[0], labels[0], {})), mesh::to_bytes(pieces[0]));
}

TEST_F(PatchOfTwoSlabs, OneThatDoesNotFitIsRefused)
{
  const auto refused = [&] {
    EXPECT_THROW(static_cast<void>(apply_patches(pieces[0], labels[0], {&patch, 1})), MeshError);
  };
  const Patch good = patch;
  patch.subdomains = {5, 6};
  refused();
  patch = good;
  patch.tet_vertices[0] = pieces[0].num_vertices();
  refused();
  patch.tet_vertices[0] = -1 - patch.num_new_vertices();
  refused();
  patch = good;
  patch.tet_offsets = {0, 0, 0};  // Takes the tets behind triangles on the geometry.
  patch.tet_vertices.clear();
  refused();
}

}  // namespace
}  // namespace tessera::improve
