// SPDX-License-Identifier: BSD-3-Clause
// The pieces in the course of the improvement, on several ranks.
#include <filesystem>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "tessera/base/error.hpp"
#include "tessera/io/files.hpp"
#include "tessera/subdomain/core_figures.hpp"
#include "tessera/subdomain/improve_seam_region.hpp"
#include "tessera/subdomain/measure_piece.hpp"

#include "pipeline/jobs/mesh_worker.hpp"
#include "pipeline/store/band_segments.hpp"
#include "pipeline/store/fill_record.hpp"
#include "pipeline/store/improved_pieces.hpp"
#include "support/decompositions.hpp"
#include "support/meshes.hpp"
#include "support/mpi_tests.hpp"
#include "support/piece_sets.hpp"

namespace tessera::pipeline {
namespace {

using Place = std::pair<LocalIndex, LocalIndex>;  // Owner, index.

constexpr GlobalIndex kAnyRim = 1'000'000;
constexpr GlobalIndex kNoRim = -1;

// Some values are on the heap: on the stack, GCC 12 thinks that members might be read before they
// are made.

// Gives the tets back as they are.
class SameTets final : public improve::Optimizer {
 public:
  [[nodiscard]] improve::TetMesh optimize(const improve::OptimizeInput& input,
                                          int /*rounds*/) const override
  {
    return input.tets;
  }
};

// The eight octants of a cube, filled, in a store.
struct ImprovedPiecesTest : ::testing::Test {
  const comm::Communicator comm{MPI_COMM_WORLD};
  const std::filesystem::path output =
      std::filesystem::current_path() / ("improved_pieces.np" + std::to_string(comm.size()));
  const testing::Body body{testing::kuhn_cube(16), testing::octants(testing::kuhn_cube(16))};
  const std::vector<mesh::Piece> made = testing::coarse_pieces(body);
  const std::shared_ptr<const improve::SeamRegions> regions =
      std::make_shared<const improve::SeamRegions>(body.skeleton, body.decomposition);

  ImprovedPiecesTest() { start_anew(0); }
  ~ImprovedPiecesTest() override { comm.barrier(); }

  // The store as fills leave it, but for the bound on rims.
  void start_anew(int first_rim) const
  {
    comm.barrier();
    if (comm.rank() == 0) {
      std::filesystem::remove_all(output);
      const GlobalIndex most_of_rim = first_rim > 0 ? kNoRim : kAnyRim;
      const io::RecordStore store(store_folder(output));
      for (const mesh::Piece& piece : made) {
        const auto segments = band_segments(improve::whole_piece(piece), *regions, 0, most_of_rim);
        std::vector<Bytes> all{to_bytes(FillRecord()), to_bytes(piece)};
        all.insert(all.end(), segments.begin(), segments.end());
        store.put(record_name(piece.subdomain), all);
      }
    }
    comm.barrier();
  }

  [[nodiscard]] ImprovedPieces open() const { return {output, body.skeleton, regions, comm}; }

  [[nodiscard]] bool is_mine(LocalIndex number) const
  {
    return number % comm.size() == comm.rank();
  }

  [[nodiscard]] subdomain::RegionRecord same_again(const ImprovedPieces& pieces,
                                                   LocalIndex region) const
  {
    const improve::RegionMesh mesh = region_mesh(pieces.bands_of(region), *regions, region);
    improve::RegionOutcome outcome = improve::improve_region(
        mesh, SameTets(), {}, [count = 0](const improve::TetMesh& /*tets*/) mutable {
          return improve::ShapeSummary{.mean_mean_ratio = 0.1 * ++count};
        });
    return {.is_improved = outcome.is_accepted, .updates = std::move(outcome.updates)};
  }

  // Rims are kept from that phase on.
  void run_phases(ImprovedPieces& pieces, int first_rim) const
  {
    for (int phase = 0; phase < improve::kNumPhases; ++phase) {
      for (LocalIndex s = 0; s < body.num_subdomains(); ++s) {
        if (phase == 0 || !is_mine(s)) continue;
        pieces.keep_bands(s, phase - 1, phase, phase < first_rim ? kNoRim : kAnyRim);
      }
      pieces.records().share();
      for (LocalIndex r = regions->first_of_phase(phase); r < regions->first_of_phase(phase + 1);
           ++r) {
        if (is_mine(r)) pieces.keep_region(r, same_again(pieces, r));
      }
      pieces.records().share();
    }
  }

  [[nodiscard]] subdomain::FillResult figures(const improve::PiecePart& part) const
  {
    return subdomain::measure_improved_part(
        part, improve::vertices_perhaps_on_seams(part.piece, *regions), {});
  }

  static void expect_same(const subdomain::FillResult& found, const subdomain::FillResult& wanted)
  {
    EXPECT_EQ(found.summary.num_tets, wanted.summary.num_tets);
    EXPECT_EQ(found.summary.num_interior_vertices, wanted.summary.num_interior_vertices);
    EXPECT_EQ(found.summary.surface, wanted.summary.surface);
    EXPECT_EQ(found.summary.tets.min_mean_ratio, wanted.summary.tets.min_mean_ratio);
    EXPECT_EQ(found.summary.seam_tets.num_tets, wanted.summary.seam_tets.num_tets);
    EXPECT_NEAR(found.summary.volume, wanted.summary.volume, 1e-12 * wanted.summary.volume);
    EXPECT_EQ(to_bytes(found.histograms), to_bytes(wanted.histograms));
  }

  // By whole lists of all other pieces.
  [[nodiscard]] number::SharedBy compared(LocalIndex subdomain) const
  {
    number::VertexList own;
    std::vector<number::VertexList> others;
    for (const mesh::Piece& piece : made) {
      number::VertexList list{piece.subdomain, piece.material, number::shared_vertices(piece)};
      (piece.subdomain == subdomain ? own : others.emplace_back()) = std::move(list);
    }
    return number::compare_lists(own, others);
  }

  void find_owners(ImprovedPieces& pieces) const
  {
    for (const mesh::Piece& piece : made) {
      if (is_mine(piece.subdomain)) pieces.keep_list(pieces.outer(piece.subdomain));
    }
    pieces.records().share();
    for (const mesh::Piece& piece : made) {
      if (is_mine(piece.subdomain)) static_cast<void>(pieces.own_vertices(piece.subdomain));
    }
    pieces.records().share();
  }
};

TEST_F(ImprovedPiecesTest, ArePiecesAsTheyWereFilledWithoutUpdates)
{
  const ImprovedPieces pieces = open();
  for (const mesh::Piece& piece : made) {
    EXPECT_EQ(to_bytes(pieces.piece(piece.subdomain)), to_bytes(piece));
  }
  EXPECT_THROW(static_cast<void>(pieces.piece(8)), InputError);
}

TEST_F(ImprovedPiecesTest, AreOneMeshAfterAllPhases)
{
  ImprovedPieces pieces = open();
  run_phases(pieces, 0);
  std::vector<mesh::Piece> improved;
  for (const mesh::Piece& piece : made) improved.push_back(pieces.piece(piece.subdomain));
  EXPECT_EQ(testing::first_flaw(improved), "");
  for (std::size_t s = 0; s < made.size(); ++s) {
    EXPECT_NE(to_bytes(improved[s]), to_bytes(made[s])) << "its free vertices have new names";
  }
}

TEST_F(ImprovedPiecesTest, AreTheSameWithAndWithoutRims)
{
  std::vector<std::vector<Bytes>> results;
  for (int first_rim = 0; first_rim <= improve::kNumPhases; ++first_rim) {
    start_anew(first_rim);
    ImprovedPieces pieces = open();
    run_phases(pieces, first_rim);
    std::vector<Bytes>& result = results.emplace_back();
    for (const mesh::Piece& piece : made) {
      result.push_back(to_bytes(pieces.piece(piece.subdomain)));
    }
    comm.barrier();
  }
  for (const auto& result : results) EXPECT_EQ(result, results[0]);
}

TEST_F(ImprovedPiecesTest, AreMeasuredWithoutTheirCore)
{
  for (int first_rim = 0; first_rim < improve::kNumPhases; ++first_rim) {
    start_anew(first_rim);
    ImprovedPieces pieces = open();
    run_phases(pieces, first_rim);
    for (LocalIndex s = 0; s < body.num_subdomains(); ++s) {
      const ImprovedPieces::Outer outer = pieces.outer(s);
      subdomain::FillResult found = figures(outer.part);
      subdomain::add_core(outer.core, outer.part, found);
      const improve::PiecePart whole = improve::whole_piece(pieces.piece(s));
      EXPECT_GT(outer.core.figures.summary.num_tets, 0);
      EXPECT_EQ(outer.core.figures.summary.seam_tets.num_tets > 0, first_rim > 0);
      expect_same(found, figures(whole));
      EXPECT_EQ(subdomain::shared_vertices(outer.core, outer.part.piece),
                number::shared_vertices(whole.piece));
    }
  }
}

TEST_F(ImprovedPiecesTest, NeighboursReadWhatTheyMayHave)
{
  ImprovedPieces pieces = open();
  find_owners(pieces);
  for (LocalIndex s = 0; s < body.num_subdomains(); ++s) {
    if (!is_mine(s)) continue;
    const ImprovedPieces::Comparison found = pieces.own_vertices(s);
    EXPECT_EQ(found.vertices, number::shared_vertices(made[at(s)]));
    EXPECT_EQ(found.shared.on_seam, compared(s).on_seam);
    EXPECT_EQ(found.shared.owned, compared(s).owned);
  }
}

TEST_F(ImprovedPiecesTest, TakeUpWhatAStoppedRunHasLeft)
{
  std::vector<Bytes> before;
  {
    ImprovedPieces pieces = open();
    run_phases(pieces, 0);
    for (const mesh::Piece& piece : made) {
      before.push_back(to_bytes(pieces.piece(piece.subdomain)));
    }
  }
  comm.barrier();
  const ImprovedPieces pieces = open();
  for (LocalIndex r = 0; r < regions->num_regions(); ++r) {
    ASSERT_TRUE(pieces.has_region(r));
    EXPECT_TRUE(pieces.find_region(r).is_improved);
  }
  for (const mesh::Piece& piece : made) {
    EXPECT_TRUE(pieces.has_bands(piece.subdomain, 2));
    EXPECT_EQ(to_bytes(pieces.piece(piece.subdomain)), before[at(piece.subdomain)]);
  }
}

TEST_F(ImprovedPiecesTest, MakeLostBandsAgainThoughLaterUpdatesAreThere)
{
  ImprovedPieces pieces = open();
  run_phases(pieces, improve::kNumPhases);
  const LocalIndex region = regions->first_of_phase(1);
  const std::vector<Bytes> before = pieces.bands_of(region);
  for (LocalIndex s = 0; s < body.num_subdomains(); ++s) {
    if (is_mine(s)) pieces.keep_bands(s, 0, 1, kNoRim);
  }
  pieces.records().share();
  EXPECT_EQ(pieces.bands_of(region), before);
}

TEST_F(ImprovedPiecesTest, EveryVertexOfTheMeshHasOneDensePlace)
{
  ImprovedPieces pieces = open();
  find_owners(pieces);
  std::map<Place, Vec3> position_of_place;
  std::map<Vec3, Place> place_of_position;
  std::vector<std::set<LocalIndex>> indices(made.size());
  for (const mesh::Piece& piece : made) {
    const std::vector<subdomain::VertexPlace> places = pieces.places_of(piece);
    EXPECT_EQ(places.size(), at(piece.num_vertices()));
    for (LocalIndex v = 0; v < piece.num_vertices(); ++v) {
      const Place place{places[at(v)].owner, places[at(v)].index};
      const Vec3 position = point_at(std::span(piece.vertex_xyz), v);
      EXPECT_EQ(position_of_place.emplace(place, position).first->second, position);
      EXPECT_EQ(place_of_position.emplace(position, place).first->second, place);
      EXPECT_LE(place.first, piece.subdomain) << "the lowest piece owns";
      indices[at(place.first)].insert(place.second);
    }
  }
  EXPECT_EQ(position_of_place.size(), at(body.coarse.num_vertices()));
  EXPECT_EQ(place_of_position.size(), at(body.coarse.num_vertices()));
  for (const std::set<LocalIndex>& of_owner : indices) {
    EXPECT_FALSE(of_owner.empty());
    EXPECT_EQ(*of_owner.begin(), 0);
    EXPECT_EQ(*of_owner.rbegin(), static_cast<LocalIndex>(of_owner.size()) - 1);
  }
}

TEST_F(ImprovedPiecesTest, SaysWhatOneMaterialShares)
{
  ImprovedPieces pieces = open();
  find_owners(pieces);
  const ImprovedPieces::Comparison found = pieces.own_vertices(0);
  std::size_t num_on_seam = 0;
  for (const char on_seam : found.shared.on_seam) num_on_seam += on_seam != 0 ? 1 : 0;
  EXPECT_EQ(num_on_seam, 217U) << "three sides of 9 x 9 vertices, of one corner";
  EXPECT_TRUE(found.is_as_expected);
  EXPECT_EQ(found.seams_of(made[0]), improve::vertices_perhaps_on_seams(made[0], *regions));
  EXPECT_EQ(found.shared.owned.size(), at(made.front().num_skin_vertices()));
}

TEST_F(ImprovedPiecesTest, NoticesASeamThatOnlyOnePieceHasKept)
{
  ImprovedPieces pieces = open();
  std::vector<mesh::Piece> changed = made;
  for (std::size_t s = 1; s < changed.size(); ++s) {
    for (LocalIndex& index : changed[s].skin_index) index += 1000;  // Nobody shares with piece 0.
  }
  for (const mesh::Piece& piece : changed) {
    const auto outer = std::make_unique<ImprovedPieces::Outer>();
    outer->part = improve::whole_piece(piece);
    if (is_mine(piece.subdomain)) pieces.keep_list(*outer);
  }
  pieces.records().share();
  EXPECT_FALSE(pieces.own_vertices(0).is_as_expected);
}

TEST_F(ImprovedPiecesTest, AVertexWithoutOwnerIsAnError)
{
  ImprovedPieces pieces = open();
  find_owners(pieces);
  mesh::Piece stranger = made[7];
  stranger.skin_index[2] += 1000;
  try {
    static_cast<void>(pieces.places_of(stranger));
    ADD_FAILURE() << "somebody owns it";
  } catch (const MeshError& error) {
    EXPECT_STREQ(error.what(), "nobody owns vertex 2 of piece 7");
  }
}

}  // namespace
}  // namespace tessera::pipeline
