// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/mesh/damping.hpp"

#include <gtest/gtest.h>

namespace tessera::mesh {
namespace {

TEST(Damping, PointsThatAreNotListedGoAllTheWay)
{
  EXPECT_EQ(Damping().factor({LatticeCarrier::edge, 3, 0}), 1.0);
  const Damping damping({{{LatticeCarrier::edge, 3, 1}, 0.5}});
  EXPECT_EQ(damping.factor({LatticeCarrier::edge, 3, 0}), 1.0);
  EXPECT_EQ(damping.factor({LatticeCarrier::triangle, 3, 1}), 1.0);
  EXPECT_EQ(damping.factor({LatticeCarrier::edge, 3, 1}), 0.5);
}

TEST(Damping, TheSmallestFactorOfAPointCountsInAnyOrder)
{
  const LatticePointKey key{LatticeCarrier::triangle, 7, 2};
  const Damping down({{key, 0.75}, {key, 0.25}, {{LatticeCarrier::edge, 0, 0}, 0.5}});
  const Damping up({{{LatticeCarrier::edge, 0, 0}, 0.5}, {key, 0.25}, {key, 0.75}});

  EXPECT_EQ(down.factor(key), 0.25);
  EXPECT_EQ(down.entries().size(), 2U);
  EXPECT_EQ(to_bytes(down), to_bytes(up));
}

}  // namespace
}  // namespace tessera::mesh
