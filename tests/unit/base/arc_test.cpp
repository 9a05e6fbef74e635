// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/base/arc.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace tessera {
namespace {

TEST(Arc, TurnsAChordIntoTheTangentsOfItsCircle)
{
  for (const double angle : {0.01, 0.5, 1.5, 2.5}) {
    // From the begin at the origin, along x.
    const Vec3 end{std::sin(angle), 1.0 - std::cos(angle), 0.0};
    const Vec3 middle{std::sin(0.5 * angle), 1.0 - std::cos(0.5 * angle), 0.0};
    const Vec3 turn = arc_turn(end, middle - 0.5 * end);
    const Vec3 begins = end + turn;
    EXPECT_NEAR(begins[1] / begins[0], 0.0, 1e-12) << angle;
    const Vec3 ends = turn - end;
    EXPECT_NEAR(ends[1] / ends[0], std::tan(angle), 1e-9 * std::abs(std::tan(angle))) << angle;
    EXPECT_NEAR(dot(begins, end), dot(end, end), 1e-12) << "as long as the chord along it";
  }
}

TEST(Arc, LeavesAStraightChord) { EXPECT_EQ(arc_turn({1.0, 2.0, 3.0}, {}), Vec3{}); }

}  // namespace
}  // namespace tessera
