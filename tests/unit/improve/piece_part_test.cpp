// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/improve/piece_part.hpp"

#include <algorithm>
#include <functional>
#include <map>
#include <span>
#include <vector>

#include <gtest/gtest.h>

#include "tessera/improve/phase_bands.hpp"
#include "tessera/improve/region_band.hpp"
#include "tessera/improve/region_update.hpp"

#include "support/bodies.hpp"
#include "support/decompositions.hpp"
#include "support/meshes.hpp"
#include "support/piece_sets.hpp"

#include "test_optimizers.hpp"

namespace tessera::improve {
namespace {

// The octants of a cube whose phases a piece goes through, each with all tets of a few layers given
// away and got back flipped.
struct PartsOfOctants : ::testing::Test {
  static constexpr int kLayers = 1;
  const testing::Body body{testing::kuhn_cube(18), testing::octants(testing::kuhn_cube(18))};
  const SeamRegions regions{body.skeleton, body.decomposition};
  std::vector<PiecePart> parts = parts_of(testing::coarse_pieces(body));

  static std::vector<PiecePart> parts_of(std::vector<mesh::Piece> pieces)
  {
    std::vector<PiecePart> parts;
    for (mesh::Piece& piece : pieces) parts.push_back(whole_piece(std::move(piece)));
    return parts;
  }

  [[nodiscard]] std::vector<LocalIndex> labels_of(const PiecePart& part, int phase) const
  {
    return label_tets(part.piece, regions, phase, kLayers);
  }

  // What each piece exchanges in a phase.
  [[nodiscard]] std::vector<std::vector<RegionExchange>> exchanges_of(int phase) const
  {
    std::vector<std::vector<RegionExchange>> exchanges(parts.size());
    std::vector<std::vector<Band>> bands;
    for (const PiecePart& part : parts) {
      bands.push_back(make_bands(part, labels_of(part, phase), regions, phase));
    }
    for (LocalIndex r = regions.first_of_phase(phase); r < regions.first_of_phase(phase + 1); ++r) {
      std::vector<Band> around;
      for (const LocalIndex s : regions.subdomains_of(r)) {
        around.push_back(bands[at(s)][testing::row_in(r, regions.regions_of(s, phase))]);
      }
      const RegionOutcome outcome =
          improve_region(extract_region(around, regions, r), testing::FlippingOptimizer(), {},
                         testing::always_better());
      for (std::size_t i = 0; i < outcome.updates.size(); ++i) {
        const LocalIndex s = regions.subdomains_of(r)[i];
        const auto tets =
            tets_of_bands(parts[at(s)], labels_of(parts[at(s)], phase), regions, phase);
        const auto row = static_cast<LocalIndex>(testing::row_in(r, regions.regions_of(s, phase)));
        exchanges[at(s)].push_back({{tets[row].begin(), tets[row].end()}, outcome.updates[i]});
      }
    }
    return exchanges;
  }

  // Brings `parts` through all phases. Returns what each piece has exchanged.
  [[nodiscard]] std::vector<std::vector<RegionExchange>> go_through_phases()
  {
    std::vector<std::vector<RegionExchange>> all(parts.size());
    for (int phase = 0; phase < kNumPhases; ++phase) {
      const auto exchanges = exchanges_of(phase);
      for (std::size_t s = 0; s < parts.size(); ++s) {
        EXPECT_FALSE(exchanges[s].empty()) << "phase " << phase;
        parts[s] = apply_updates(parts[s], exchanges[s]);
        all[s].insert(all[s].end(), exchanges[s].begin(), exchanges[s].end());
      }
    }
    return all;
  }
};

using CornersOfTag = std::map<LocalIndex, std::array<Vec3, 4>>;

CornersOfTag labelled(const PiecePart& part, const std::vector<LocalIndex>& labels)
{
  CornersOfTag corners;
  for (LocalIndex t = 0; t < part.piece.num_tets(); ++t) {
    if (labels[at(t)] != kNoIndex) corners[part.tet_tag[at(t)]] = part.piece.corners(t);
  }
  return corners;
}

CornersOfTag all_corners(const PiecePart& part)
{
  return labelled(part, std::vector<LocalIndex>(part.tet_tag.size(), 0));
}

// Every tet of the part is one of the other, with its name and place.
void expect_same_tets(const PiecePart& part, const PiecePart& whole)
{
  const CornersOfTag all = all_corners(whole);
  const CornersOfTag some = all_corners(part);
  EXPECT_FALSE(some.empty());
  for (const auto& [tag, corners] : some) EXPECT_EQ(all.at(tag), corners) << tag;
  for (LocalIndex v = 0; v < part.piece.num_skin_vertices(); ++v) {
    const auto tags = std::span(whole.vertex_tag).first(at(whole.piece.num_skin_vertices()));
    const auto found = std::ranges::lower_bound(tags, part.vertex_tag[at(v)]);
    ASSERT_NE(found, tags.end());
    EXPECT_EQ(whole.piece.skin_point(static_cast<LocalIndex>(found - tags.begin())),
              part.piece.skin_point(v));
  }
}

TEST_F(PartsOfOctants, AllPhasesAtOnceGiveWhatOneAfterTheOtherGives)
{
  const std::vector<PiecePart> filled = parts;
  const auto all = go_through_phases();
  std::vector<mesh::Piece> pieces;
  for (std::size_t s = 0; s < parts.size(); ++s) {
    EXPECT_EQ(to_bytes(apply_updates(filled[s], all[s])), to_bytes(parts[s]));
    pieces.push_back(parts[s].piece);
  }
  EXPECT_EQ(testing::first_flaw(pieces), "");
}

TEST_F(PartsOfOctants, TheRimHasWhatLaterPhasesNeed)
{
  const auto exchanges = exchanges_of(0);
  for (std::size_t s = 0; s < parts.size(); ++s) {
    const PiecePart rim = rim_of(parts[s], regions, 0, 3);
    EXPECT_LT(rim.piece.num_tets(), parts[s].piece.num_tets());
    const PiecePart whole_after = apply_updates(parts[s], exchanges[s]);
    const PiecePart rim_after = apply_updates(rim, exchanges[s]);
    EXPECT_EQ(rim_after.num_vertex_tags, whole_after.num_vertex_tags);
    EXPECT_EQ(rim_after.num_tet_tags, whole_after.num_tet_tags);
    const CornersOfTag wanted = labelled(whole_after, labels_of(whole_after, 1));
    EXPECT_FALSE(wanted.empty());
    EXPECT_EQ(labelled(rim_after, labels_of(rim_after, 1)), wanted);
  }
}

TEST_F(PartsOfOctants, TheOuterPartHasWhatAnyPhaseExchanges)
{
  const std::vector<PiecePart> filled = parts;
  const auto all = go_through_phases();
  for (std::size_t s = 0; s < parts.size(); ++s) {
    const PhaseBands kept = make_phase_bands(filled[s], regions, 0, filled[s].piece.num_tets());
    ASSERT_TRUE(kept.rim.has_value());
    const PiecePart outer = outer_part(kept);
    EXPECT_LT(outer.piece.num_tets(), filled[s].piece.num_tets());
    EXPECT_TRUE(std::ranges::is_sorted(outer.tet_tag, std::less_equal<>()));
    expect_same_tets(outer, filled[s]);
    const PiecePart outer_after = apply_updates(outer, all[s]);
    EXPECT_EQ(outer_after.piece.num_tets() - outer.piece.num_tets(),
              parts[s].piece.num_tets() - filled[s].piece.num_tets());
    expect_same_tets(outer_after, parts[s]);
  }
}

TEST_F(PartsOfOctants, ARimThatIsTooLargeIsLeftOut)
{
  EXPECT_FALSE(make_phase_bands(parts[0], regions, 0, 1).rim.has_value());
}

TEST_F(PartsOfOctants, TheRimOfTheLastPhaseIsEmpty)
{
  const PiecePart rim = rim_of(parts[0], regions, kNumPhases - 1);
  EXPECT_EQ(rim.piece.num_tets(), 0);
  EXPECT_EQ(rim.num_tet_tags, parts[0].num_tet_tags);
}

TEST_F(PartsOfOctants, BandsNameTheirVerticesByTags)
{
  const auto exchanges = exchanges_of(0);
  const PiecePart part = apply_updates(parts[0], exchanges[0]);
  std::map<LocalIndex, Vec3> position;
  for (LocalIndex v = 0; v < part.piece.num_vertices(); ++v) {
    position[part.vertex_tag[at(v)]] = point_at(std::span(part.piece.vertex_xyz), v);
  }
  const auto bands = make_bands(part, labels_of(part, 1), regions, 1);
  ASSERT_EQ(bands.size(), regions.regions_of(0, 1).size());
  for (const Band& band : bands) {
    ASSERT_GT(band.num_tets(), 0);
    for (LocalIndex v = 0; v < band.num_vertices(); ++v) {
      EXPECT_EQ(position.at(band.vertex_tag[at(v)]), point_at(std::span(band.vertex_xyz), v));
    }
  }
}

}  // namespace
}  // namespace tessera::improve
