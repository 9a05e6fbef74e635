// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/improve/region_update.hpp"

#include <algorithm>
#include <span>
#include <vector>

#include <gtest/gtest.h>

#include "tessera/base/error.hpp"
#include "tessera/improve/region_band.hpp"

#include "support/bodies.hpp"
#include "support/decompositions.hpp"
#include "support/meshes.hpp"
#include "support/piece_sets.hpp"

#include "test_optimizers.hpp"

namespace tessera::improve {
namespace {

// Two halves of a cube, and the updates of the seam between them.
struct UpdateOfTwoSlabs : ::testing::Test {
  const testing::Body body{testing::kuhn_cube(4), testing::slabs(testing::kuhn_cube(4), 2)};
  const SeamRegions regions{body.skeleton, body.decomposition};
  const std::vector<mesh::Piece> pieces = testing::coarse_pieces(body);
  const std::vector<std::vector<LocalIndex>> labels{label_tets(pieces[0], regions, 0, 1),
                                                    label_tets(pieces[1], regions, 0, 1)};
  const std::vector<PieceUpdate> updates = make();

  [[nodiscard]] std::vector<PieceUpdate> make() const
  {
    return improve_region(
               extract_region(testing::bands_of_region(pieces, regions, 0, 1), regions, 0),
               testing::FlippingOptimizer(), {}, testing::always_better())
        .updates;
  }

  [[nodiscard]] RegionExchange exchange_of(std::size_t s) const
  {
    const auto tets = tets_of_bands(whole_piece(pieces[s]), labels[s], regions, 0);
    return {tets.values.to_vector(), updates[s]};
  }

  [[nodiscard]] PiecePart apply(std::size_t s, const RegionExchange& exchange) const
  {
    return apply_updates(whole_piece(pieces[s]), {&exchange, 1});
  }

  void SetUp() override { ASSERT_EQ(updates.size(), 2U); }
};

TEST_F(UpdateOfTwoSlabs, IsTheSameAfterATripThroughBytes)
{
  EXPECT_EQ(from_bytes<PieceUpdate>(to_bytes(updates[0])), updates[0]);
}

TEST_F(UpdateOfTwoSlabs, PutsTheTetsThatStayFirstAndInOrder)
{
  for (std::size_t s = 0; s < 2; ++s) {
    const PiecePart part = apply(s, exchange_of(s));
    const mesh::Piece& improved = part.piece;
    LocalIndex next = 0;
    for (LocalIndex t = 0; t < pieces[s].num_tets(); ++t) {
      if (labels[s][at(t)] == 0) continue;
      EXPECT_EQ(part.tet_tag[at(next)], t);
      EXPECT_EQ(improved.corners(next++), pieces[s].corners(t));
    }
    EXPECT_EQ(improved.num_tets(), next + updates[s].num_tets());
    EXPECT_EQ(improved.boundary_patch, pieces[s].boundary_patch);
  }
}

TEST_F(UpdateOfTwoSlabs, GivesNewTagsBehindAllThatWereGiven)
{
  const PiecePart part = apply(0, exchange_of(0));
  EXPECT_EQ(part.num_tet_tags, pieces[0].num_tets() + updates[0].num_tets());
  EXPECT_EQ(part.tet_tag.back(), part.num_tet_tags - 1);
  EXPECT_EQ(part.num_vertex_tags, pieces[0].num_vertices() + updates[0].num_new_vertices());
  EXPECT_GT(updates[0].num_new_vertices(), 0);
  const auto num_skin = part.piece.num_skin_vertices();
  EXPECT_TRUE(std::ranges::is_sorted(std::span(part.vertex_tag).first(at(num_skin))));
  EXPECT_TRUE(std::ranges::is_sorted(std::span(part.vertex_tag).subspan(at(num_skin))));
}

TEST_F(UpdateOfTwoSlabs, GivesSharedVerticesTheRegionsHost)
{
  ASSERT_GT(updates[0].num_shared(), 0);
  EXPECT_EQ(updates[0].shared_index, updates[1].shared_index);
  for (std::size_t s = 0; s < 2; ++s) {
    const mesh::Piece improved = apply(s, exchange_of(s)).piece;
    std::vector<LocalIndex> found;
    for (LocalIndex v = 0; v < improved.num_skin_vertices(); ++v) {
      if (improved.skin_host[at(v)] == regions.host_of(0)) {
        found.push_back(improved.skin_index[at(v)]);
      }
    }
    EXPECT_EQ(found, updates[s].shared_index);
  }
}

TEST_F(UpdateOfTwoSlabs, NoUpdateChangesNothing)
{
  EXPECT_EQ(to_bytes(apply_updates(whole_piece(pieces[0]), {}).piece), to_bytes(pieces[0]));
}

TEST_F(UpdateOfTwoSlabs, OneThatDoesNotFitIsRefused)
{
  const auto expect_refused = [&](const auto& spoil) {
    RegionExchange exchange = exchange_of(0);
    spoil(exchange.update);
    EXPECT_THROW(static_cast<void>(apply(0, exchange)), MeshError);
  };
  expect_refused(
      [&](PieceUpdate& update) { update.tet_vertices[0] = pieces[0].num_vertices() + 1000; });
  expect_refused(
      [](PieceUpdate& update) { update.tet_vertices[0] = -1 - update.num_new_vertices(); });
  // Takes the tets behind triangles on the geometry.
  expect_refused([](PieceUpdate& update) { update.tet_vertices.clear(); });
}

}  // namespace
}  // namespace tessera::improve
