// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "tessera/mesh/lattice.hpp"
#include "tessera/subdomain/refine_piece.hpp"

#include "support/curved_models.hpp"
#include "support/decompositions.hpp"
#include "support/flat_model.hpp"
#include "support/meshes.hpp"
#include "support/piece_sets.hpp"

#include "split_pieces.hpp"

namespace tessera::subdomain {
namespace {

using fill::KernelKind;
using testing::SplitPiece;

// A cube whose bottom has a bump that no point of level 1 is on: higher than the body, so that no
// smoothing helps. It stands in one octant.
class BumpyCube {
 public:
  static inline const testing::SplitTask kTask{1, 2};

  BumpyCube()
      : body(testing::kuhn_cube(2), testing::octants(testing::kuhn_cube(2))),
        model([](double x, double y) {
          const auto wave = [](double t) { return std::sin(4.0 * std::numbers::pi * t); };
          const bool is_there = x < 0.45 && y < 0.45;
          return is_there ? 1.5 * std::pow(wave(x) * wave(x) + wave(y) * wave(y), 2) : 0.0;
        }),
        filled(testing::fill_all(body, testing::FlatModel(), kTask.from, KernelKind::optimize))
  {
  }

  [[nodiscard]] std::vector<SplitPiece> split(const mesh::ProjectionLimiter& limiter) const
  {
    return testing::split_all(body, model, kTask, filled, limiter);
  }

  testing::Body body;
  testing::GraphModel model;
  std::vector<FilledPiece> filled;
};

std::vector<mesh::PointLimit> folds_of(const std::vector<SplitPiece>& split)
{
  std::vector<mesh::PointLimit> folds;
  for (const SplitPiece& one : split) {
    EXPECT_EQ(one.made.filled.result.summary.is_folded, !one.made.folds.empty());
    EXPECT_EQ(one.made.filled.piece.num_tets() == 0, !one.made.folds.empty());
    folds.insert(folds.end(), one.made.folds.begin(), one.made.folds.end());
  }
  return folds;
}

TEST(FoldedPieces, NameNewPointsOnTheGeometry)
{
  const BumpyCube cube;
  const auto split = cube.split({});
  EXPECT_FALSE(split.front().made.folds.empty()) << "no piece is folded: nothing is tested";
  EXPECT_TRUE(split.back().made.folds.empty());
  const mesh::Skeleton& skeleton = cube.body.skeleton;
  const LocalIndex step = mesh::lattice::intervals(mesh::lattice::kMaxLevels) / 2;
  for (const mesh::PointLimit& fold : folds_of(split)) {
    EXPECT_EQ(fold.factor, 0.0);
    const bool is_on_edge = fold.key.carrier == mesh::LatticeCarrier::edge;
    const auto entity = at(fold.key.entity);
    EXPECT_NE(is_on_edge ? skeleton.edge_patch[entity] : skeleton.triangle_patch[entity], kNoIndex);
    if (!is_on_edge) continue;
    EXPECT_NE((fold.key.index + 1) % step, 0) << "a point that the piece has already";
  }
}

// As the refine stage does it.
TEST(FoldedPieces, AreMadeWithTheirPointsHeldBack)
{
  const BumpyCube cube;
  mesh::ProjectionLimiter limiter;
  std::vector<SplitPiece> split = cube.split(limiter);
  int num_rounds = 0;
  for (auto folds = folds_of(split); !folds.empty(); folds = folds_of(split)) {
    ASSERT_LT(++num_rounds, 10);
    folds.insert(folds.end(), limiter.entries().begin(), limiter.entries().end());
    mesh::ProjectionLimiter lower(std::move(folds));
    ASSERT_NE(lower, limiter);
    limiter = std::move(lower);
    split = cube.split(limiter);
  }
  EXPECT_GT(num_rounds, 0);
  EXPECT_EQ(testing::first_flaw(testing::pieces_of(split)), "");
  EXPECT_GT(split.front().made.filled.result.summary.num_held_back, 0);
  EXPECT_GT(split.front().made.filled.result.summary.held_back_distance, 0.5);
  for (const SplitPiece& one : split) {
    const PieceSummary& summary = one.made.filled.result.summary;
    const auto skin = testing::refine_skin(cube.body, cube.model, BumpyCube::kTask.to,
                                           summary.subdomain, limiter, true);
    EXPECT_EQ(summary.num_held_back, skin.lattice.distance.num_held_back);
    EXPECT_EQ(summary.held_back_distance, skin.lattice.distance.largest_held_back);
    EXPECT_EQ(summary.model_distance, skin.lattice.distance.largest);
  }
}

}  // namespace
}  // namespace tessera::subdomain
