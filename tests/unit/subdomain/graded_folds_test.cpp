// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "support/curved_models.hpp"
#include "support/decompositions.hpp"
#include "support/flat_model.hpp"
#include "support/graded_meshes.hpp"
#include "support/meshes.hpp"
#include "support/piece_sets.hpp"

#include "split_pieces.hpp"

namespace tessera::subdomain {
namespace {

using fill::KernelKind;
using testing::Body;
using testing::SplitPiece;

constexpr int kMostRounds = 100;

// Waves of the bottom, far higher than the tets beside it.
testing::GraphModel bump_of(double height, double num_waves)
{
  return testing::GraphModel([=](double x, double y) {
    const auto wave = [&](double t) {
      return std::pow(std::sin(num_waves * std::numbers::pi * t), 2);
    };
    return height * (wave(x) + wave(y));
  });
}

struct GradedFolds : ::testing::TestWithParam<std::uint32_t> {
  mesh::CoarseMesh coarse = testing::shuffled(testing::kuhn_cube(2), GetParam());
  Body body{coarse, testing::octants(coarse)};
  mesh::EdgeLevels levels =
      testing::random_levels(coarse, 1 + static_cast<int>(GetParam() % 3), 0.6, GetParam());
};

TEST_P(GradedFolds, AreHeldBackUntilAllChildrenArePositive)
{
  const testing::GraphModel model = bump_of(0.6, 3.0);
  const testing::Plan plan = testing::plan_of(body, model, levels);
  EXPECT_GT(plan.num_rounds, 0) << "nothing folds: nothing is tested";
  std::vector<mesh::Piece> pieces;
  for (const FilledPiece& filled :
       testing::fill_all(body, model, levels, KernelKind::subdivide, plan.limiter)) {
    EXPECT_FALSE(filled.result.summary.is_folded);
    EXPECT_LT(filled.result.summary.model_distance, 1e-12);
    pieces.push_back(filled.piece);
  }
  EXPECT_EQ(testing::first_flaw(pieces), "");
}

// Their bottom is flat on the levels that they are filled on.
TEST_P(GradedFolds, OfPiecesThatAreSplitEndTooWhateverTheKernel)
{
  const int largest = levels.largest();
  const testing::GraphModel model = bump_of(1.5, std::ldexp(2.0, largest));
  int num_folded = 0;
  for (const KernelKind kernel : {KernelKind::subdivide, KernelKind::optimize}) {
    const auto filled = testing::fill_all(body, testing::FlatModel(), levels, kernel);
    const testing::SplitTask task{levels, levels.shifted(1), kernel};
    mesh::ProjectionLimiter limiter;
    std::vector<SplitPiece> split;
    for (int round = 0; round < kMostRounds; ++round) {
      split = testing::split_all(body, model, task, filled, limiter);
      std::vector<mesh::PointLimit> folds;
      for (const SplitPiece& one : split) {
        folds.insert(folds.end(), one.made.folds.begin(), one.made.folds.end());
      }
      if (folds.empty()) break;
      ++num_folded;
      mesh::ProjectionLimiter next = testing::lower(limiter, std::move(folds));
      ASSERT_NE(next, limiter) << "nothing is left to hold back in round " << round;
      limiter = std::move(next);
    }
    for (const SplitPiece& one : split) EXPECT_FALSE(one.made.filled.result.summary.is_folded);
    EXPECT_EQ(testing::first_flaw(testing::pieces_of(split)), "");
  }
  EXPECT_GT(num_folded, 0) << "nothing folds: nothing is tested";
}

INSTANTIATE_TEST_SUITE_P(Seeds, GradedFolds, ::testing::Range(1U, 10U));

}  // namespace
}  // namespace tessera::subdomain
