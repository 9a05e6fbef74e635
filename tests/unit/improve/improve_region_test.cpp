// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/improve/improve_region.hpp"

#include <limits>
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

using testing::Body;

// All phases with an optimiser that changes much and improves nothing; returns how many vertices
// had to be put in so that all tets have a subdomain.
[[nodiscard]] LocalIndex change_all(const Body& body, int layers)
{
  const SeamRegions regions(body.skeleton, body.decomposition);
  std::vector<mesh::Piece> pieces = testing::coarse_pieces(body);
  EXPECT_EQ(testing::first_flaw(pieces), "");
  const testing::FlippingOptimizer optimizer;
  testing::ImproveSetup setup{optimizer};
  setup.layers = layers;
  setup.measure = testing::always_better();
  LocalIndex num_splits = 0;
  for (int phase = 0; phase < kNumPhases; ++phase) {
    const testing::PhaseCount count = testing::improve_phase(regions, phase, setup, pieces);
    EXPECT_EQ(count.num_accepted, regions.first_of_phase(phase + 1) - regions.first_of_phase(phase))
        << (count.refusals.empty() ? "" : count.refusals.front());
    EXPECT_EQ(testing::first_flaw(pieces), "") << "phase " << phase;
    EXPECT_NEAR(testing::volume_of(pieces), 1.0, 1e-12);
    num_splits += count.num_splits;
  }
  return num_splits;
}

TEST(ImproveRegion, LeavesOneMeshOfOctants)
{
  const mesh::CoarseMesh cube = testing::kuhn_cube(6);
  EXPECT_GT(change_all({cube, testing::octants(cube)}, 2), 0);
}

TEST(ImproveRegion, LeavesOneMeshWhereRegionsTakeAllOfAPiece)
{
  const mesh::CoarseMesh cube = testing::kuhn_cube(4);
  EXPECT_GT(change_all({cube, testing::octants(cube)}, 4), 0);
}

TEST(ImproveRegion, LeavesOneMeshOfThinPieces)
{
  // Slabs of one layer of cells: regions of either side meet in the middle of each.
  const mesh::CoarseMesh cube = testing::kuhn_cube(6);
  static_cast<void>(change_all({cube, testing::slabs(cube, 6)}, 3));
}

TEST(ImproveRegion, KeepsTheInterfaceOfTwoMaterials)
{
  const mesh::CoarseMesh cube = testing::two_material_cube(6);
  EXPECT_GT(change_all({cube, testing::octants(cube)}, 2), 0);
}

// The region between two halves of a cube.
struct OneRegion : ::testing::Test {
  const Body body{testing::kuhn_cube(4), testing::slabs(testing::kuhn_cube(4), 2)};
  const SeamRegions regions{body.skeleton, body.decomposition};
  const std::vector<mesh::Piece> pieces = testing::coarse_pieces(body);
  RegionMesh mesh{};

  OneRegion()
  {
    mesh = extract_region(testing::bands_of_region(pieces, regions, 0, 1), regions, 0);
  }

  void expect_refused(const testing::ChangingOptimizer::Change& change, const std::string& because)
  {
    try {
      static_cast<void>(
          improve_region(mesh, testing::ChangingOptimizer(change), {}, testing::always_better()));
      ADD_FAILURE() << "accepted";
    } catch (const MeshError& error) {
      EXPECT_NE(std::string(error.what()).find(because), std::string::npos) << error.what();
    }
  }
};

TEST_F(OneRegion, RefusesWhatAnOptimiserMayNotDo)
{
  expect_refused([](TetMesh& tets) { tets.vertex_xyz[0] += 1e-14; }, "moved");
  expect_refused([](TetMesh& tets) { tets.tet_vertices.resize(tets.tet_vertices.size() - 4); },
                 "boundary");
  expect_refused([](TetMesh& tets) { tets.tet_vertices[0] = 1 << 20; }, "names vertex");
  expect_refused([](TetMesh& tets) { tets.tet_vertices[0] = -1; }, "names vertex");
  expect_refused(
      [&](TetMesh& tets) {  // A free vertex goes far outside.
        tets.vertex_xyz[3 * at(mesh.num_fixed())] += 10.0;
      },
      "has volume");
}

TEST_F(OneRegion, RefusesTetsThatFillSomethingElse)
{
  // The same tets again, on copies of their vertices: closed, but not the old boundary.
  expect_refused(
      [](TetMesh& tets) {
        const auto shift = static_cast<LocalIndex>(tets.vertex_xyz.size() / 3);
        const auto xyz = tets.vertex_xyz;
        const auto copies = tets.tet_vertices;
        tets.vertex_xyz.insert(tets.vertex_xyz.end(), xyz.begin(), xyz.end());
        for (const LocalIndex v : copies) tets.tet_vertices.push_back(v + shift);
      },
      "boundary");
}

TEST_F(OneRegion, KeepsItsTetsWithAReasonIfTheNewOnesAreNotBetter)
{
  const testing::ChangingOptimizer nothing([](TetMesh&) {});
  const RegionOutcome outcome = improve_region(mesh, nothing, {}, testing::measure_shapes);
  EXPECT_FALSE(outcome.is_accepted);
  EXPECT_NE(outcome.reason, "");
  EXPECT_TRUE(outcome.updates.empty());
}

TEST_F(OneRegion, IsAPureFunction)
{
  const testing::FlippingOptimizer optimizer;
  const auto once = improve_region(mesh, optimizer, {}, testing::always_better());
  const auto again = improve_region(mesh, optimizer, {}, testing::always_better());
  EXPECT_TRUE(once.is_accepted);
  EXPECT_FALSE(once.updates.empty());
  EXPECT_EQ(once.updates, again.updates);
}

TEST(Refusal, WantsABetterMeanAndNoWorseWorst)
{
  const ShapeSummary before{8.0, 0.3, 0.8};
  EXPECT_EQ(refusal(before, {8.0, 0.3, 0.81}), "");
  EXPECT_NE(refusal(before, {8.0, 0.3, 0.8}), "");
  EXPECT_NE(refusal(before, {7.9, 0.3, 0.81}), "");
  EXPECT_NE(refusal(before, {8.0, 0.29, 0.81}), "");
}

TEST(Refusal, LetsAGoodWorstBecomeWorseWhileItStaysGood)
{
  const ShapeSummary before{30.0, 0.6, 0.8};
  EXPECT_EQ(refusal(before, {15.0, 0.4, 0.81}), "");
  EXPECT_NE(refusal(before, {14.9, 0.4, 0.81}), "");
  EXPECT_NE(refusal(before, {15.0, 0.39, 0.81}), "");
}

TEST(Refusal, CountsNoNumberAsWorse)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(refusal({8.0, 0.3, 0.8}, {8.0, 0.3, nan}), "");
}

}  // namespace
}  // namespace tessera::improve
