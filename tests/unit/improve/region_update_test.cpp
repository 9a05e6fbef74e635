// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/improve/region_update.hpp"

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

// Two halves of a cube, and the update of the seam between them.
struct UpdateOfTwoSlabs : ::testing::Test {
  const testing::Body body{testing::kuhn_cube(4), testing::slabs(testing::kuhn_cube(4), 2)};
  const SeamRegions regions{body.skeleton, body.decomposition};
  const std::vector<mesh::Piece> pieces = testing::coarse_pieces(body);
  const std::vector<std::vector<LocalIndex>> labels{label_tets(pieces[0], regions, 0, 1),
                                                    label_tets(pieces[1], regions, 0, 1)};
  RegionUpdate update = make();

  [[nodiscard]] RegionUpdate make() const
  {
    const std::vector<LabelledPiece> around{{pieces[0], labels[0]}, {pieces[1], labels[1]}};
    return improve_region(extract_region(around, regions, 0), testing::FlippingOptimizer(), {},
                          testing::always_better())
        .update;
  }
};

TEST_F(UpdateOfTwoSlabs, IsTheSameAfterATripThroughBytes)
{
  EXPECT_EQ(from_bytes<RegionUpdate>(to_bytes(update)), update);
}

TEST_F(UpdateOfTwoSlabs, PutsTheTetsThatStayFirstAndInOrder)
{
  for (std::size_t s = 0; s < 2; ++s) {
    const mesh::Piece improved = apply_updates(pieces[s], labels[s], {&update, 1});
    LocalIndex next = 0;
    for (LocalIndex t = 0; t < pieces[s].num_tets(); ++t) {
      if (labels[s][at(t)] == 0) continue;
      EXPECT_EQ(improved.corners(next++), pieces[s].corners(t));
    }
    EXPECT_EQ(improved.num_tets(), next + update.tet_offsets[s + 1] - update.tet_offsets[s]);
    EXPECT_EQ(improved.boundary_patch, pieces[s].boundary_patch);
  }
}

TEST_F(UpdateOfTwoSlabs, GivesSharedVerticesTheRegionsUnit)
{
  ASSERT_GT(update.num_shared, 0);
  for (std::size_t s = 0; s < 2; ++s) {
    const mesh::Piece improved = apply_updates(pieces[s], labels[s], {&update, 1});
    std::vector<char> is_found(at(update.num_shared), 0);
    for (LocalIndex v = 0; v < improved.num_skin_vertices(); ++v) {
      if (improved.skin_host[at(v)] == regions.host_of(0)) {
        is_found[at(improved.skin_index[at(v)])] = 1;
      }
    }
    EXPECT_EQ(is_found, std::vector<char>(at(update.num_shared), 1));
  }
}

TEST_F(UpdateOfTwoSlabs, NoPatchChangesNothing)
{
  EXPECT_EQ(to_bytes(apply_updates(pieces[0], labels[0], {})), to_bytes(pieces[0]));
}

TEST_F(UpdateOfTwoSlabs, OneThatDoesNotFitIsRefused)
{
  const auto refused = [&] {
    EXPECT_THROW(static_cast<void>(apply_updates(pieces[0], labels[0], {&update, 1})), MeshError);
  };
  const RegionUpdate good = update;
  update.subdomains = {5, 6};
  refused();
  update = good;
  update.tet_vertices[0] = pieces[0].num_vertices();
  refused();
  update.tet_vertices[0] = -1 - update.num_new_vertices();
  refused();
  update = good;
  update.tet_offsets = {0, 0, 0};  // Takes the tets behind triangles on the geometry.
  update.tet_vertices.clear();
  refused();
}

}  // namespace
}  // namespace tessera::improve
