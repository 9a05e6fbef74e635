// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/mesh/projection_limiter.hpp"

#include <cmath>
#include <cstring>
#include <vector>

#include <gtest/gtest.h>

#include "tessera/base/bytes.hpp"
#include "tessera/base/error.hpp"

namespace tessera::mesh {
namespace {

TEST(ProjectionLimiter, PointsThatAreNotListedGoAllTheWay)
{
  EXPECT_EQ(ProjectionLimiter().factor({LatticeCarrier::edge, 3, 0}), 1.0);
  const ProjectionLimiter limiter({{{LatticeCarrier::edge, 3, 1}, 0.5}});
  EXPECT_EQ(limiter.factor({LatticeCarrier::edge, 3, 0}), 1.0);
  EXPECT_EQ(limiter.factor({LatticeCarrier::triangle, 3, 1}), 1.0);
  EXPECT_EQ(limiter.factor({LatticeCarrier::edge, 3, 1}), 0.5);
}

TEST(ProjectionLimiter, TheSmallestFactorOfAPointCountsInAnyOrder)
{
  const LatticePointKey key{LatticeCarrier::triangle, 7, 2};
  const ProjectionLimiter down({{key, 0.75}, {key, 0.25}, {{LatticeCarrier::edge, 0, 0}, 0.5}});
  const ProjectionLimiter up({{{LatticeCarrier::edge, 0, 0}, 0.5}, {key, 0.25}, {key, 0.75}});

  EXPECT_EQ(down.factor(key), 0.25);
  EXPECT_EQ(down.entries().size(), 2U);
  EXPECT_EQ(to_bytes(down), to_bytes(up));
  EXPECT_EQ(down, up);
}

TEST(ProjectionLimiter, IsAnotherWithAnotherPointOrFactor)
{
  const ProjectionLimiter one({{{LatticeCarrier::edge, 3, 1}, 0.5}});
  EXPECT_NE(one, ProjectionLimiter());
  EXPECT_NE(one, ProjectionLimiter({{{LatticeCarrier::edge, 3, 1}, 0.25}}));
  EXPECT_NE(one, ProjectionLimiter({{{LatticeCarrier::triangle, 3, 1}, 0.5}}));
}

// A plan is broadcast as bytes: the same plan must give the same ones.
TEST(ProjectionLimiter, BytesAreAFunctionOfTheEntries)
{
  std::vector<PointLimit> one(50);
  std::vector<PointLimit> other(50);
  std::memset(static_cast<void*>(one.data()), 0x00, one.size() * sizeof(PointLimit));
  std::memset(static_cast<void*>(other.data()), 0xFF, other.size() * sizeof(PointLimit));
  for (LocalIndex i = 0; i < 50; ++i) {
    for (auto* entries : {&one, &other}) {
      PointLimit& entry = (*entries)[static_cast<std::size_t>(i)];
      entry.key.carrier = LatticeCarrier::edge;
      entry.key.entity = i;
      entry.key.index = 2 * i;
      entry.factor = 0.25;
    }
  }
  const Bytes bytes = to_bytes(ProjectionLimiter(one));
  EXPECT_EQ(bytes, to_bytes(ProjectionLimiter(other)));

  const ProjectionLimiter back = from_bytes<ProjectionLimiter>(bytes);
  ASSERT_EQ(back.entries().size(), 50U);
  EXPECT_EQ(back.factor({LatticeCarrier::edge, 49, 98}), 0.25);
}

// Who writes the bytes writes fields; a limiter promises more.
TEST(ProjectionLimiter, BytesThatBreakItsPromisesAreRefused)
{
  const auto read = [](const std::vector<PointLimit>& entries) {
    return from_bytes<ProjectionLimiter>(to_bytes(entries));
  };
  const LatticePointKey low{LatticeCarrier::edge, 3, 1};
  const LatticePointKey high{LatticeCarrier::triangle, 0, 0};
  EXPECT_EQ(read({{low, 0.0}, {high, 1.0}}).factor(low), 0.0);
  const std::vector<std::vector<PointLimit>> damaged{
      {{high, 0.5}, {low, 0.5}}, {{low, 0.5}, {low, 0.25}}, {{low, -0.5}}, {{low, 1.5}},
      {{low, std::nan("")}},
  };
  for (const auto& entries : damaged) {
    EXPECT_THROW(static_cast<void>(read(entries)), InputError);
  }
}

}  // namespace
}  // namespace tessera::mesh
