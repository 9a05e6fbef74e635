// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/store/improved_pieces.hpp"

#include <map>
#include <set>
#include <utility>

#include <gtest/gtest.h>

#include "tessera/base/error.hpp"

#include "pipeline/store/fill_record.hpp"
#include "support/decompositions.hpp"
#include "support/meshes.hpp"
#include "support/piece_sets.hpp"
#include "support/temporary_folder.hpp"

namespace tessera::pipeline {
namespace {

using Place = std::pair<LocalIndex, LocalIndex>;  // Owner, index.

// The eight octants of a cube as pieces of generation 1 in a store.
struct ImprovedPiecesTest : ::testing::Test {
  static constexpr int kGeneration = 1;
  const testing::TemporaryFolder output{};
  const testing::Body body{testing::kuhn_cube(4), testing::octants(testing::kuhn_cube(4))};
  const std::vector<mesh::Piece> made = testing::coarse_pieces(body);
  const io::RecordStore store{store_folder(output.path())};
  const ImprovedPieces pieces{output.path(), body.skeleton, kGeneration};

  ImprovedPiecesTest()
  {
    for (const mesh::Piece& piece : made) {
      store.put(improved_name(piece.subdomain, kGeneration), to_bytes(piece));
    }
  }

  void find_owners() const
  {
    for (const mesh::Piece& piece : made) pieces.keep_list(piece);
    for (const mesh::Piece& piece : made) {
      static_cast<void>(pieces.own_vertices(piece.subdomain));
    }
  }
};

TEST_F(ImprovedPiecesTest, GivesBackThePiecesOfItsGeneration)
{
  for (const mesh::Piece& piece : made) {
    EXPECT_EQ(to_bytes(pieces.piece(piece.subdomain)), to_bytes(piece));
  }
  EXPECT_THROW(static_cast<void>(stored_piece(store, 0, kGeneration + 1)), InputError);
}

TEST_F(ImprovedPiecesTest, GenerationZeroIsAsItWasFilled)
{
  EXPECT_THROW(static_cast<void>(stored_piece(store, 3, 0)), InputError);
  FillRecord record;
  record.piece = to_bytes(made[5]);
  store.put(record_name(3), to_bytes(record));
  EXPECT_EQ(to_bytes(stored_piece(store, 3, 0)), record.piece);
}

TEST_F(ImprovedPiecesTest, EveryVertexOfTheMeshHasOnePlace)
{
  find_owners();
  std::map<Place, Vec3> position_of_place;
  std::map<Vec3, Place> place_of_position;
  for (const mesh::Piece& piece : made) {
    const std::vector<subdomain::VertexPlace> places = pieces.places_of(piece);
    ASSERT_EQ(places.size(), at(piece.num_vertices()));
    for (LocalIndex v = 0; v < piece.num_vertices(); ++v) {
      const Place place{places[at(v)].owner, places[at(v)].index};
      const Vec3 position = point_at(std::span(piece.vertex_xyz), v);
      EXPECT_EQ(position_of_place.emplace(place, position).first->second, position);
      EXPECT_EQ(place_of_position.emplace(position, place).first->second, place);
    }
  }
  EXPECT_EQ(position_of_place.size(), at(body.coarse.num_vertices()));
  EXPECT_EQ(place_of_position.size(), at(body.coarse.num_vertices()));
}

TEST_F(ImprovedPiecesTest, PlacesOfAnOwnerAreDense)
{
  find_owners();
  std::vector<std::set<LocalIndex>> indices(made.size());
  for (const mesh::Piece& piece : made) {
    for (const auto& [owner, index] : pieces.places_of(piece)) indices[at(owner)].insert(index);
  }
  for (const std::set<LocalIndex>& of_owner : indices) {
    ASSERT_FALSE(of_owner.empty());
    EXPECT_EQ(*of_owner.begin(), 0);
    EXPECT_EQ(*of_owner.rbegin(), static_cast<LocalIndex>(of_owner.size()) - 1);
  }
}

TEST_F(ImprovedPiecesTest, TheLowestPieceOwnsWhatItShares)
{
  find_owners();
  for (const auto& place : pieces.places_of(made.front())) EXPECT_EQ(place.owner, 0);
  LocalIndex num_of_others = 0;
  for (const auto& place : pieces.places_of(made.back())) {
    EXPECT_LE(place.owner, made.back().subdomain);
    if (place.owner != made.back().subdomain) ++num_of_others;
  }
  EXPECT_EQ(num_of_others, 3 * 9 - 3 * 3 + 1) << "three sides of 3 x 3 vertices, of one corner";
}

TEST_F(ImprovedPiecesTest, SaysWhatOneMaterialShares)
{
  for (const mesh::Piece& piece : made) pieces.keep_list(piece);
  const number::SharedBy shared = pieces.own_vertices(0);
  std::size_t num_on_seam = 0;
  for (const char on_seam : shared.on_seam) num_on_seam += on_seam != 0 ? 1 : 0;
  EXPECT_EQ(num_on_seam, 19U);
  EXPECT_EQ(shared.owned.size(), at(made.front().num_skin_vertices()));
}

TEST_F(ImprovedPiecesTest, AVertexWithoutOwnerIsAnError)
{
  find_owners();
  mesh::Piece stranger = made[7];
  stranger.skin_index[2] += 1000;
  const std::string text =
      testing::message_of<MeshError>([&] { static_cast<void>(pieces.places_of(stranger)); });
  EXPECT_EQ(text, "nobody owns vertex 2 of piece 7");
}

TEST_F(ImprovedPiecesTest, NamesOfRecordsDifferByPieceAndGeneration)
{
  std::set<std::string> names{record_name(12)};
  for (const LocalIndex s : {0, 1, 12, 1'000'000}) {
    for (const int generation : {1, 2, 3}) names.insert(improved_name(s, generation));
  }
  EXPECT_EQ(names.size(), 13U);
}

}  // namespace
}  // namespace tessera::pipeline
