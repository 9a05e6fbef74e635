// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/base/affine.hpp"

#include <gtest/gtest.h>

namespace tessera {
namespace {

// By a right angle about z: x goes to y, y to -x.
constexpr Affine kTurn{{{{0.0, -1.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, 0.0, 1.0}}}, {1.0, 2.0, 3.0}};
// By a right angle about x: y goes to z, z to -y.
constexpr Affine kRoll{{{{1.0, 0.0, 0.0}, {0.0, 0.0, -1.0}, {0.0, 1.0, 0.0}}}, {0.0, 0.0, 8.0}};
constexpr Vec3 kPoint{1.0, 10.0, 100.0};

TEST(Affine, IsTheIdentityAsItBegins)
{
  EXPECT_EQ(Affine{}(kPoint), kPoint);
  EXPECT_EQ(Affine{}.inverse(), Affine{});
}

TEST(Affine, TurnsBeforeItShifts)
{
  EXPECT_EQ(kTurn.turned(kPoint), (Vec3{-10.0, 1.0, 100.0}));
  EXPECT_EQ(kTurn(kPoint), (Vec3{-9.0, 3.0, 103.0}));
}

TEST(Affine, HasAnInverseThatLeadsBack)
{
  for (const Affine& there : {kTurn, kRoll}) {
    EXPECT_EQ(there.inverse()(there(kPoint)), kPoint);
    EXPECT_EQ(there(there.inverse()(kPoint)), kPoint);
    EXPECT_EQ(there.inverse().inverse(), there);
  }
}

TEST(Product, IsTheFirstAndThenTheOther)
{
  EXPECT_EQ(product(kRoll, kTurn)(kPoint), kRoll(kTurn(kPoint)));
  EXPECT_EQ(product(kTurn, kRoll)(kPoint), kTurn(kRoll(kPoint)));
  EXPECT_NE(product(kRoll, kTurn), product(kTurn, kRoll));
}

TEST(Product, HasTheIdentityAsItsOne)
{
  EXPECT_EQ(product(kTurn, Affine{}), kTurn);
  EXPECT_EQ(product(Affine{}, kTurn), kTurn);
  EXPECT_EQ(product(kTurn.inverse(), kTurn), Affine{});
}

}  // namespace
}  // namespace tessera
