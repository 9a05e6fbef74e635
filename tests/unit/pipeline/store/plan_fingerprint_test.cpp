// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include "tessera/mesh/lattice.hpp"

#include "pipeline/store/fill_record.hpp"
#include "support/bodies.hpp"
#include "support/decompositions.hpp"
#include "support/meshes.hpp"

namespace tessera::pipeline {
namespace {

using mesh::LatticePointKey;

// Four slabs of a cube: 0 touches 1, 1 touches 2, 2 touches 3.
struct PlanFingerprint : ::testing::Test {
  const testing::Body body{testing::kuhn_cube(4), testing::slabs(testing::kuhn_cube(4), 4)};
  const Hash128 cut{17, 4};

  [[nodiscard]] Hash128 of(LocalIndex first, LocalIndex last,
                           std::vector<mesh::PointLimit> limits) const
  {
    return plan_fingerprint(cut, body.skeleton, mesh::ProjectionLimiter(std::move(limits)), first,
                            last);
  }

  // A triangle between two subdomains, or on the outside of one (kNoIndex).
  [[nodiscard]] LocalIndex triangle_between(LocalIndex one, LocalIndex other) const
  {
    for (LocalIndex t = 0; t < body.skeleton.num_triangles(); ++t) {
      const LocalIndex* sides = &body.skeleton.triangle_subdomains[2 * at(t)];
      if (std::minmax(sides[0], sides[1]) == std::minmax(one, other)) return t;
    }
    ADD_FAILURE() << "there is no such triangle";
    return 0;
  }

  static mesh::PointLimit on_triangle(LocalIndex triangle, double factor)
  {
    return {LatticePointKey::on_triangle(triangle, 4, {1, 2}), factor};
  }
  static mesh::PointLimit on_edge(LocalIndex edge, double factor)
  {
    return {LatticePointKey::on_edge(edge, 4, 1), factor};
  }
};

TEST_F(PlanFingerprint, OfAnEmptyPlanIsTheCuts) { EXPECT_EQ(of(0, 1, {}), cut); }

TEST_F(PlanFingerprint, DependsOnTheCut)
{
  const std::vector<mesh::PointLimit> limits{on_triangle(triangle_between(0, 1), 0.5)};
  EXPECT_NE(of(0, 1, limits),
            plan_fingerprint({17, 5}, body.skeleton, mesh::ProjectionLimiter(limits), 0, 1));
}

TEST_F(PlanFingerprint, APointInsideASeamBearsOnBothSidesOnly)
{
  const mesh::PointLimit elsewhere = on_triangle(triangle_between(kNoIndex, 3), 0.5);
  const mesh::PointLimit on_seam = on_triangle(triangle_between(0, 1), 0.5);
  for (const LocalIndex s : {0, 1}) {
    EXPECT_NE(of(s, s + 1, {elsewhere, on_seam}), of(s, s + 1, {elsewhere}));
  }
  for (const LocalIndex s : {2, 3}) {
    EXPECT_EQ(of(s, s + 1, {elsewhere, on_seam}), of(s, s + 1, {elsewhere}));
  }
}

TEST_F(PlanFingerprint, APointOnAnEdgeBearsOnAllAroundIt)
{
  const LocalIndex triangle = triangle_between(2, 3);
  const mesh::PointLimit elsewhere = on_triangle(triangle_between(kNoIndex, 0), 0.5);
  for (std::size_t side = 0; side < 3; ++side) {
    const mesh::PointLimit limit =
        on_edge(body.skeleton.triangle_edges[3 * at(triangle) + side], 0.5);
    EXPECT_NE(of(2, 3, {elsewhere, limit}), of(2, 3, {elsewhere}));
    EXPECT_NE(of(3, 4, {elsewhere, limit}), of(3, 4, {elsewhere}));
    EXPECT_EQ(of(0, 1, {elsewhere, limit}), of(0, 1, {elsewhere}));
  }
}

// Edges and triangles have numbers of their own: the same number may be both.
TEST_F(PlanFingerprint, ATriangleIsNotTakenForTheEdgeOfTheSameNumber)
{
  const auto triangles = body.skeleton.triangles_of(0);
  std::set<LocalIndex> edges;
  for (const LocalIndex t : triangles) {
    const LocalIndex* sides = &body.skeleton.triangle_edges[3 * at(t)];
    edges.insert(sides, sides + 3);
  }
  const auto triangle = std::ranges::find_if(edges, [&](LocalIndex number) {
    return number < body.skeleton.num_triangles()
           && std::ranges::find(triangles, number) == triangles.end();
  });
  ASSERT_NE(triangle, edges.end()) << "there is no such number: nothing is tested";
  const mesh::PointLimit elsewhere = on_triangle(triangle_between(kNoIndex, 0), 0.5);
  EXPECT_EQ(of(0, 1, {elsewhere, on_triangle(*triangle, 0.5)}), of(0, 1, {elsewhere}));
}

TEST_F(PlanFingerprint, ChangesWithFactorAndPoint)
{
  const LocalIndex triangle = triangle_between(0, 1);
  const Hash128 half = of(0, 1, {on_triangle(triangle, 0.5)});
  EXPECT_EQ(of(0, 1, {on_triangle(triangle, 0.5)}), half);
  EXPECT_NE(of(0, 1, {on_triangle(triangle, 0.25)}), half);
  EXPECT_NE(of(0, 1, {{LatticePointKey::on_triangle(triangle, 4, {2, 1}), 0.5}}), half);
}

TEST_F(PlanFingerprint, OfARangeSeesAllOfIt)
{
  const mesh::PointLimit elsewhere = on_triangle(triangle_between(kNoIndex, 0), 0.5);
  const mesh::PointLimit limit = on_triangle(triangle_between(kNoIndex, 2), 0.5);
  EXPECT_NE(of(1, 3, {elsewhere, limit}), of(1, 3, {elsewhere}));
  EXPECT_EQ(of(0, 2, {elsewhere, limit}), of(0, 2, {elsewhere}));
  EXPECT_EQ(of(3, 4, {elsewhere, limit}), of(3, 4, {elsewhere}));
}

TEST(CutFingerprint, ChangesWithMeshAndSubdomains)
{
  const mesh::CoarseMesh cube = testing::kuhn_cube(4);
  mesh::CoarseMesh moved = cube;
  moved.vertex_xyz[0] = -1e-9;
  const auto of = [](const mesh::CoarseMesh& coarse, const mesh::Decomposition& decomposition,
                     int levels = 1) {
    return cut_fingerprint(subdomain::PartitionedMesh(coarse, decomposition, levels));
  };
  const mesh::Decomposition four = testing::slabs(cube, 4);
  const mesh::Decomposition two = testing::slabs(cube, 2);
  EXPECT_EQ(of(cube, four), of(cube, four));
  EXPECT_NE(of(cube, four), of(moved, four));
  EXPECT_NE(of(cube, four), of(cube, two));
  EXPECT_NE(of(cube, four), of(cube, four, 2));
}

}  // namespace
}  // namespace tessera::pipeline
