// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "tessera/mesh/refined_lattice.hpp"
#include "tessera/refine/lattice_refiner.hpp"

#include "support/bodies.hpp"
#include "support/curved_meshes.hpp"
#include "support/curved_models.hpp"
#include "support/decompositions.hpp"

namespace tessera::refine {
namespace {

using testing::Body;

struct DistanceToModel : ::testing::Test {
  const Body body{testing::ball(2), testing::one_subdomain_a_material(testing::ball(2))};
  const testing::SphereModel sphere{{1.0}};

  [[nodiscard]] mesh::ModelDistance distance(const model::Model& model, int levels,
                                             const mesh::ProjectionLimiter& limiter = {}) const
  {
    return testing::refine_skin(body, model, levels, 0, limiter, true).lattice.distance;
  }

  // Distance of the longest chord's midpoint from the sphere at level 1.
  [[nodiscard]] double largest_sagitta() const
  {
    const auto [complex, lattice] = testing::refine_skin(body, sphere, 0, 0);
    double largest = 0.0;
    for (LocalIndex e = 0; e < complex.num_edges(); ++e) {
      largest = std::max(largest,
                         1.0 - norm(midpoint(lattice.edge_point(e, 0), lattice.edge_point(e, 1))));
    }
    return largest;
  }
};

TEST_F(DistanceToModel, OfAnExactProjectionIsRounding)
{
  const mesh::ModelDistance found = distance(sphere, 3);
  EXPECT_LE(found.largest, 1e-15);
  EXPECT_EQ(found.largest_held_back, 0.0);
  EXPECT_EQ(found.num_held_back, 0);
}

TEST_F(DistanceToModel, ShowsAProjectionThatStopsEarly)
{
  const testing::LazyModel lazy(sphere, 0.9);
  // The projection leaves a tenth of the way, and its second try covers nine tenths of that.
  EXPECT_NEAR(distance(lazy, 1).largest, 0.9 * 0.1 * largest_sagitta(), 1e-12);
}

TEST_F(DistanceToModel, ShowsAProjectionOntoRimsThatStopsEarly)
{
  const Body cylinder(testing::cylinder(2),
                      testing::one_subdomain_a_material(testing::cylinder(2)));
  const testing::CylinderModel round;
  const testing::LazyModel lazy(round, 0.5);
  const auto found = testing::refine_skin(cylinder, lazy, 1, 0, {}, true).lattice.distance;
  EXPECT_NEAR(found.largest, 0.25 * (1.0 - std::cos(std::acos(-1.0) / 8.0)), 1e-12);
}

TEST_F(DistanceToModel, KeepsHeldBackPointsApart)
{
  const mesh::ProjectionLimiter limiter({{mesh::LatticePointKey::on_edge(2, 2, 1), 0.25}});
  const auto lattice = testing::refine_skin(body, sphere, 1, 0, limiter, true).lattice;
  EXPECT_LE(lattice.distance.largest, 1e-15);
  EXPECT_EQ(lattice.distance.num_held_back, 1);
  EXPECT_NEAR(lattice.distance.largest_held_back, 1.0 - norm(lattice.edge_point(2, 1)), 1e-15);
  EXPECT_GT(lattice.distance.largest_held_back, 1e-3);
}

TEST_F(DistanceToModel, IsNotMeasuredUnlessAsked)
{
  const testing::LazyModel lazy(sphere, 0.9);
  const auto lattice = testing::refine_skin(body, lazy, 2, 0).lattice;
  EXPECT_EQ(lattice.distance.largest, 0.0);
}

TEST_F(DistanceToModel, MeasuringMovesNothing)
{
  const auto with = testing::refine_skin(body, sphere, 3, 0, {}, true).lattice;
  const auto without = testing::refine_skin(body, sphere, 3, 0, {}, false).lattice;
  EXPECT_TRUE(std::ranges::equal(with.edge_points(), without.edge_points()));
  EXPECT_TRUE(std::ranges::equal(with.triangle_points(), without.triangle_points()));
}

}  // namespace
}  // namespace tessera::refine
