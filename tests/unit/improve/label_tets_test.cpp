// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include "tessera/improve/seam_regions.hpp"

#include "support/bodies.hpp"
#include "support/decompositions.hpp"
#include "support/meshes.hpp"
#include "support/piece_sets.hpp"

namespace tessera::improve {
namespace {

// The octants of a cube of 8^3 cells.
struct LabelsOfOctants : ::testing::Test {
  const testing::Body body{testing::kuhn_cube(8), testing::octants(testing::kuhn_cube(8))};
  const SeamRegions regions{body.skeleton, body.decomposition};
  const std::vector<mesh::Piece> pieces = testing::coarse_pieces(body);

  // The region of a phase that a vertex of a piece is on.
  [[nodiscard]] LocalIndex seed(const mesh::Piece& piece, LocalIndex v, int phase) const
  {
    if (v >= piece.num_skin_vertices()) return kNoIndex;
    const LocalIndex region = regions.region_of(piece.skin_host[at(v)], piece.material);
    return region != kNoIndex && regions.phase_of(region) == phase ? region : kNoIndex;
  }
};

TEST_F(LabelsOfOctants, FirstLayerTouchesTheRegionsUnits)
{
  for (int phase = 0; phase < kNumPhases; ++phase) {
    for (const mesh::Piece& piece : pieces) {
      const auto labels = label_tets(piece, regions, phase, 1);
      EXPECT_LT(std::count(labels.begin(), labels.end(), kNoIndex), piece.num_tets());
      for (LocalIndex t = 0; t < piece.num_tets(); ++t) {
        LocalIndex lowest = kNoIndex;
        for (std::size_t c = 0; c < 4; ++c) {
          const LocalIndex region = seed(piece, piece.tet_vertices[4 * at(t) + c], phase);
          if (region != kNoIndex && (lowest == kNoIndex || region < lowest)) lowest = region;
        }
        EXPECT_EQ(labels[at(t)], lowest);
      }
    }
  }
}

TEST_F(LabelsOfOctants, LaterLayersGrowAndLeaveEarlierOnesAlone)
{
  const mesh::Piece& piece = pieces[3];
  for (int phase = 0; phase < kNumPhases; ++phase) {
    auto fewer = label_tets(piece, regions, phase, 1);
    for (int layers = 2; layers <= 4; ++layers) {
      const auto more = label_tets(piece, regions, phase, layers);
      LocalIndex num_new = 0;
      for (std::size_t t = 0; t < more.size(); ++t) {
        if (fewer[t] != kNoIndex) {
          EXPECT_EQ(more[t], fewer[t]);
          continue;
        }
        if (more[t] == kNoIndex) continue;
        ++num_new;
        // It shares a vertex with a tet of the layer before, of the same region.
        const bool touches = std::any_of(
            piece.tet_vertices.begin() + static_cast<std::ptrdiff_t>(4 * t),
            piece.tet_vertices.begin() + static_cast<std::ptrdiff_t>(4 * t + 4), [&](LocalIndex v) {
              for (std::size_t i = 0; i < piece.tet_vertices.size(); ++i) {
                if (piece.tet_vertices[i] == v && fewer[i / 4] == more[t]) return true;
              }
              return false;
            });
        EXPECT_TRUE(touches);
      }
      EXPECT_GT(num_new, 0) << "phase " << phase << ", layer " << layers;
      fewer = more;
    }
  }
}

// Of the regions that reach a tet in the same layer the lowest has it, by whichever vertex.
TEST_F(LabelsOfOctants, OfEquallyNearRegionsTheLowestHasTheTet)
{
  LocalIndex num_contested = 0;
  for (int phase = 0; phase < kNumPhases; ++phase) {
    for (const mesh::Piece& piece : pieces) {
      const auto first = label_tets(piece, regions, phase, 1);
      const auto second = label_tets(piece, regions, phase, 2);
      std::vector<std::set<LocalIndex>> reach(at(piece.num_vertices()));
      for (std::size_t i = 0; i < piece.tet_vertices.size(); ++i) {
        if (first[i / 4] != kNoIndex) reach[at(piece.tet_vertices[i])].insert(first[i / 4]);
      }
      for (std::size_t t = 0; t < first.size(); ++t) {
        if (first[t] != kNoIndex) continue;
        std::set<LocalIndex> near;
        for (std::size_t c = 0; c < 4; ++c)
          near.merge(std::set(reach[at(piece.tet_vertices[4 * t + c])]));
        EXPECT_EQ(second[t], near.empty() ? kNoIndex : *near.begin());
        num_contested += near.size() > 1 ? 1 : 0;
      }
    }
  }
  EXPECT_GT(num_contested, 0);
}

TEST_F(LabelsOfOctants, AreThoseOfTheRegionsOfThePiece)
{
  for (const mesh::Piece& piece : pieces) {
    for (int phase = 0; phase < kNumPhases; ++phase) {
      const auto mine = regions.regions_of(piece.subdomain, phase);
      EXPECT_FALSE(mine.empty());
      for (const LocalIndex label : label_tets(piece, regions, phase, 3)) {
        EXPECT_TRUE(label == kNoIndex || std::binary_search(mine.begin(), mine.end(), label));
      }
    }
  }
}

TEST_F(LabelsOfOctants, VerticesOfAnEarlierPhaseAreNoSeeds)
{
  mesh::Piece piece = pieces[0];
  for (LocalIndex v = 0; v < piece.num_skin_vertices(); ++v) {
    if (seed(piece, v, 0) != kNoIndex) piece.skin_host[at(v)] = regions.host_of(0);
  }
  const auto labels = label_tets(piece, regions, 0, 3);
  EXPECT_EQ(std::count(labels.begin(), labels.end(), kNoIndex), piece.num_tets());
}

}  // namespace
}  // namespace tessera::improve
