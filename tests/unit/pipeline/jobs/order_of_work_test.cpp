// SPDX-License-Identifier: BSD-3-Clause
#include <vector>

#include <gtest/gtest.h>

#include "pipeline/jobs/for_each_dynamic.hpp"
#include "pipeline/store/filled_pieces.hpp"

namespace tessera::pipeline {
namespace {

TEST(OrderOfWork, TheHeaviestComesFirstAndEqualOnesInTheirOrder)
{
  EXPECT_EQ(heaviest_first({2.0, 5.0, 2.0, 7.0, 5.0}), (std::vector<LocalIndex>{3, 1, 4, 0, 2}));
  EXPECT_TRUE(heaviest_first({}).empty());
}

TEST(OrderOfWork, AsTheyComeIsAscending)
{
  EXPECT_EQ(in_order(4), (std::vector<LocalIndex>{0, 1, 2, 3}));
}

TEST(FilledPieces, SumUpWhatPiecesSay)
{
  FilledPieces all;
  all.seam_sums.resize(3);
  subdomain::FillResult result;
  result.summary.subdomain = 4;
  result.summary.num_tets = 10;
  result.histograms.mean_ratio.add(0.5);
  result.seams = {{0, {1, 2}}, {2, {3, 4}}};
  all.add(result);
  result.summary.subdomain = 6;
  result.seams = {{2, {10, 20}}};
  result.failures = {"try 1 (netgen): gave up"};
  all.add(result);
  EXPECT_EQ(all.num_tets(), 20);
  EXPECT_EQ(all.pieces.size(), 2U);
  EXPECT_EQ(all.histograms.mean_ratio.total(), 2);
  EXPECT_EQ(all.seam_sums, (std::vector<Hash128>{{1, 2}, {}, {13, 24}}));
  ASSERT_EQ(all.failures.size(), 1U);
  EXPECT_EQ(all.failures[0].subdomain, 6);
}

// It has no tets, so nothing of it may count.
TEST(FilledPieces, AFoldedOneIsNoPiece)
{
  FilledPieces all;
  all.seam_sums.resize(1);
  subdomain::FillResult result;
  result.summary.subdomain = 4;
  result.summary.is_folded = true;
  result.summary.was_limited = true;
  result.seams = {{0, {1, 2}}};
  all.add(result);
  EXPECT_TRUE(all.pieces.empty());
  EXPECT_EQ(all.seam_sums[0], Hash128{});
  ASSERT_EQ(all.folded.size(), 1U);
  EXPECT_EQ(all.folded[0].subdomain, 4);
  EXPECT_TRUE(all.folded[0].was_limited);
}

}  // namespace
}  // namespace tessera::pipeline
