// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

#include "tessera/mesh/lattice.hpp"
#include "tessera/refine/lattice_refiner.hpp"

#include "support/bodies.hpp"
#include "support/curved_meshes.hpp"
#include "support/curved_models.hpp"
#include "support/decompositions.hpp"

namespace tessera::refine {
namespace {

using mesh::LatticePointKey;
using mesh::lattice::TrianglePoint;
using testing::bits;
using testing::Body;

// A ball with one edge and one triangle held back.
struct HeldBackPoints : ::testing::Test {
  static constexpr int kLevels = 2;
  const Body body{testing::ball(2), testing::one_subdomain_a_material(testing::ball(2))};
  const testing::SphereModel sphere{{1.0}};
  const mesh::Complex complex = mesh::skin_complex(body.skeleton, 0);

  [[nodiscard]] mesh::RefinedLattice refined(std::vector<mesh::PointLimit> entries) const
  {
    const mesh::ProjectionLimiter limiter(std::move(entries));
    return testing::refine_skin(body, sphere, kLevels, 0, limiter).lattice;
  }
};

TEST_F(HeldBackPoints, GoTheirShareOfTheWay)
{
  const LocalIndex edge = 5;
  const LocalIndex triangle = 7;
  const TrianglePoint inner{1, 2};  // Between (2, 1) and (0, 3), new at the last level.
  for (const double factor : {0.75, 0.5, 0.25, 0.0}) {
    const auto lattice = refined({{LatticePointKey::on_edge(edge, 4, 1), factor},
                                  {LatticePointKey::on_triangle(triangle, 4, inner), factor}});
    const Vec3 on_edge = midpoint(lattice.edge_point(edge, 0), lattice.edge_point(edge, 2));
    EXPECT_NEAR(norm(lattice.edge_point(edge, 1) - on_edge), factor * (1.0 - norm(on_edge)), 1e-15);
    const auto [a, b] = mesh::lattice::parents(inner, 1);
    const Vec3 chord =
        midpoint(lattice.triangle_point(triangle, a), lattice.triangle_point(triangle, b));
    EXPECT_NEAR(norm(lattice.triangle_point(triangle, inner) - chord), factor * (1.0 - norm(chord)),
                1e-15);
  }
}

TEST_F(HeldBackPoints, AtZeroAreExactlyTheMidpoint)
{
  const auto lattice = refined({{LatticePointKey::on_edge(0, 4, 2), 0.0}});
  EXPECT_EQ(bits(lattice.edge_point(0, 2)),
            bits(midpoint(lattice.edge_point(0, 0), lattice.edge_point(0, 4))));
}

TEST_F(HeldBackPoints, MoveNoPointButTheirDescendants)
{
  const LocalIndex edge = 3;
  const auto free = refined({});
  const auto held_back =
      refined({{LatticePointKey::on_edge(edge, 4, 3), 0.0}});  // Last level: no child.
  for (LocalIndex e = 0; e < complex.num_edges(); ++e) {
    for (LocalIndex k = 0; k <= 4; ++k) {
      const bool same = bits(free.edge_point(e, k)) == bits(held_back.edge_point(e, k));
      EXPECT_EQ(same, e != edge || k != 3);
    }
  }
}

// A point that the plan pulled back is where its children start from.
TEST_F(HeldBackPoints, OfTheFirstLevelCarryTheirChildrenAlong)
{
  const auto lattice = refined({{LatticePointKey::on_edge(0, 4, 2), 0.0}});
  const Vec3 chord = midpoint(lattice.edge_point(0, 0), lattice.edge_point(0, 2));
  EXPECT_NEAR(norm(lattice.edge_point(0, 1) - (1.0 / norm(chord)) * chord), 0.0, 1e-15);
}

TEST_F(HeldBackPoints, AreSeenAlikeFromTwoSubdomains)
{
  const Body halves(body.coarse, testing::halves(body.coarse));
  std::vector<mesh::PointLimit> entries;
  for (LocalIndex e = 0; e < halves.skeleton.num_edges(); ++e) {
    for (LocalIndex k = 1; k < 4; ++k) entries.push_back({LatticePointKey::on_edge(e, 4, k), 0.5});
  }
  const mesh::ProjectionLimiter limiter(entries);
  const auto one = testing::refine_skin(halves, sphere, kLevels, 0, limiter);
  const auto other = testing::refine_skin(halves, sphere, kLevels, 1, limiter);
  LocalIndex shared = 0;
  for (LocalIndex e = 0; e < one.complex.num_edges(); ++e) {
    const auto& known = other.complex.edge_skeleton;
    const auto place = std::find(known.begin(), known.end(), one.complex.edge_skeleton[at(e)]);
    if (place == known.end()) continue;
    ++shared;
    for (LocalIndex k = 0; k <= 4; ++k) {
      EXPECT_EQ(bits(one.lattice.edge_point(e, k)),
                bits(other.lattice.edge_point(static_cast<LocalIndex>(place - known.begin()), k)));
    }
  }
  EXPECT_GT(shared, 0);
}

}  // namespace
}  // namespace tessera::refine
