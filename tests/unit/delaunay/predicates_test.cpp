// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/delaunay/predicates.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <utility>

#include <gtest/gtest.h>

namespace tessera::delaunay {
namespace {

__extension__ using Int128 = __int128;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

int sign_of(Int128 value) { return (value > 0 ? 1 : 0) - (value < 0 ? 1 : 0); }

// Determinants by rows and the definition, of whole numbers.
template <std::size_t size>
Int128 determinant(const std::array<std::array<Int128, size>, size>& rows)
{
  if constexpr (size == 1) {
    return rows[0][0];
  } else {
    Int128 sum = 0;
    for (std::size_t skipped = 0; skipped < size; ++skipped) {
      std::array<std::array<Int128, size - 1>, size - 1> minor{};
      for (std::size_t row = 1; row < size; ++row) {
        for (std::size_t i = 0; i + 1 < size; ++i) {
          minor[row - 1][i] = rows[row][i < skipped ? i : i + 1];
        }
      }
      sum += (skipped % 2 == 0 ? 1 : -1) * rows[0][skipped] * determinant(minor);
    }
    return sum;
  }
}

Int128 whole(double x) { return static_cast<Int128>(x); }

int true_orientation(const std::array<Vec3, 5>& p)
{
  std::array<std::array<Int128, 3>, 3> rows{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      rows[i][axis] = whole(p[i + 1][axis]) - whole(p[0][axis]);
    }
  }
  return sign_of(determinant(rows));
}

// Of a positive tet the last row is below the plane through the others if it is inside.
int true_side_of_sphere(const std::array<Vec3, 5>& p)
{
  std::array<std::array<Int128, 4>, 4> rows{};
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const Int128 x = whole(p[i][axis]) - whole(p[4][axis]);
      rows[i][axis] = x;
      rows[i][3] += x * x;
    }
  }
  return -sign_of(determinant(rows));
}

class Numbers {
 public:
  double whole_number(int most)
  {
    return static_cast<double>(std::uniform_int_distribution<int>(-most, most)(engine_));
  }
  // Of magnitudes from 2^-60 to 2^30, so that differences are not exact.
  double uneven_number()
  {
    const double mantissa = std::uniform_real_distribution<double>(-1.0, 1.0)(engine_);
    return std::ldexp(mantissa, std::uniform_int_distribution<int>(-60, 30)(engine_));
  }
  bool coin() { return std::uniform_int_distribution<int>(0, 1)(engine_) == 1; }
  std::mt19937& engine() { return engine_; }

 private:
  std::mt19937 engine_{7};
};

TEST(Predicates, SayPositiveForATetInVtkOrderAndItsCentre)
{
  const Vec3 a{0, 0, 0};
  const Vec3 b{1, 0, 0};
  const Vec3 c{0, 1, 0};
  const Vec3 d{0, 0, 1};
  EXPECT_EQ(orient3d(a, b, c, d), 1);
  EXPECT_EQ(orient3d(a, c, b, d), -1);
  EXPECT_EQ(insphere(a, b, c, d, {0.5, 0.5, 0.5}), 1);
  EXPECT_EQ(insphere(a, b, c, d, {1, 1, 1}), 0);
  EXPECT_EQ(insphere(a, b, c, d, {1, 1, 1.5}), -1);
  EXPECT_EQ(insphere(a, c, b, d, {0.5, 0.5, 0.5}), -1);
}

TEST(Predicates, AgreeWithWholeNumbersWhereTiesAreCommon)
{
  Numbers numbers;
  std::array<int, 3> num_of_sign{};
  for (int i = 0; i < 20'000; ++i) {
    const int most = i % 2 == 0 ? 2 : 1000;
    std::array<Vec3, 5> p{};
    for (Vec3& point : p) {
      for (double& x : point) x = numbers.whole_number(most);
    }
    ASSERT_EQ(orient3d(p[0], p[1], p[2], p[3]), true_orientation(p));
    const int side = true_side_of_sphere(p);
    ASSERT_EQ(insphere(p[0], p[1], p[2], p[3], p[4]), side);
    ++num_of_sign[static_cast<std::size_t>(side + 1)];
  }
  for (const int num : num_of_sign) EXPECT_GT(num, 100);
}

// Determinants with two equal columns, and with one that differs in the last bit of one number.
TEST(Predicates, SeeTheLastBitBesideAPlane)
{
  Numbers numbers;
  int num_moved = 0;
  for (int i = 0; i < 5'000; ++i) {
    std::array<Vec3, 4> p{};
    for (Vec3& point : p) {
      point = {numbers.uneven_number(), numbers.uneven_number(), 0.0};
      point[2] = point[0];
    }
    ASSERT_EQ(orient3d(p[0], p[1], p[2], p[3]), 0);
    const std::array<Vec3, 3> base{p[0], p[1], p[2]};
    p[3][2] = std::nextafter(p[3][2], kInfinity);
    const int side = orient3d(p[0], p[1], p[2], p[3]);
    // The base lies on the plane z = x, and its orientation there is that of x and y.
    const int turn = orient3d({base[0][0], base[0][1], 0.0}, {base[1][0], base[1][1], 0.0},
                              {base[2][0], base[2][1], 0.0}, {0.0, 0.0, 0x1p40});
    ASSERT_EQ(side, turn);
    num_moved += side != 0 ? 1 : 0;
  }
  EXPECT_GT(num_moved, 4'900);
}

// Permuted coordinates with other signs have the same distance from the origin, exactly.
TEST(Predicates, SeeTheLastBitBesideASphere)
{
  Numbers numbers;
  int num_positive = 0;
  for (int i = 0; i < 3'000; ++i) {
    const Vec3 p{numbers.uneven_number(), numbers.uneven_number(), numbers.uneven_number()};
    std::array<Vec3, 5> q{};
    for (Vec3& point : q) {
      point = p;
      std::ranges::shuffle(point, numbers.engine());
      for (double& x : point) x = numbers.coin() ? x : -x;
    }
    if (orient3d(q[0], q[1], q[2], q[3]) < 0) std::swap(q[0], q[1]);
    if (orient3d(q[0], q[1], q[2], q[3]) <= 0) continue;
    ++num_positive;
    ASSERT_EQ(insphere(q[0], q[1], q[2], q[3], q[4]), 0);
    Vec3 inside = q[4];
    inside[0] = std::nextafter(inside[0], 0.0);
    ASSERT_EQ(insphere(q[0], q[1], q[2], q[3], inside), 1);
    Vec3 outside = q[4];
    outside[2] = std::nextafter(outside[2], outside[2] > 0.0 ? kInfinity : -kInfinity);
    ASSERT_EQ(insphere(q[0], q[1], q[2], q[3], outside), -1);
  }
  EXPECT_GT(num_positive, 1'000);
}

TEST(Predicates, AreExactAtBothEndsOfTheRange)
{
  for (const double scale : {kLeastCoordinate, kMostCoordinate / 4.0}) {
    const double next = std::nextafter(scale, kInfinity);
    const Vec3 a{-scale, 0, 0};
    const Vec3 b{scale, 0, 0};
    const Vec3 c{0, scale, 0};
    const Vec3 d{0, 0, scale};
    ASSERT_EQ(orient3d(a, b, c, d), 1);
    EXPECT_EQ(insphere(a, b, c, d, {0, 0, -scale}), 0);
    EXPECT_EQ(insphere(a, b, c, d, {0, 0, -next}), -1);
    EXPECT_EQ(insphere(a, b, c, d, {0, 0, -std::nextafter(scale, 0.0)}), 1);
    EXPECT_EQ(orient3d(a, b, {0, scale, scale}, {0, next, next}), 0);
    EXPECT_NE(orient3d(a, b, {0, scale, scale}, {0, next, scale}), 0);
  }
}

// Of five points on a sphere, the answers for all tets of them must fit one Delaunay mesh: either
// two tets or three. So of the two ways to divide a double pyramid just one is chosen.
TEST(Predicates, BreakTiesTheSameWayForWhicheverTet)
{
  Numbers numbers;
  int num_tied = 0;
  for (int i = 0; i < 20'000; ++i) {
    std::array<Vec3, 5> p{};
    for (Vec3& point : p) {
      for (double& x : point) x = numbers.whole_number(1);
    }
    if (orient3d(p[0], p[1], p[2], p[3]) <= 0 || orient3d(p[0], p[2], p[1], p[4]) <= 0) continue;
    num_tied += insphere(p[0], p[1], p[2], p[3], p[4]) == 0 ? 1 : 0;
    const int side = insphere_untied(p[0], p[1], p[2], p[3], p[4]);
    ASSERT_NE(side, 0);
    ASSERT_EQ(insphere_untied(p[1], p[2], p[0], p[3], p[4]), side);
    ASSERT_EQ(insphere_untied(p[0], p[2], p[1], p[4], p[3]), side);
  }
  EXPECT_GT(num_tied, 100);
}

TEST(Predicates, KnowWhatLiesOnALine)
{
  EXPECT_TRUE(are_collinear({0, 0, 0}, {1, 2, 3}, {-2, -4, -6}));
  EXPECT_TRUE(are_collinear({0.1, 0.1, 0.1}, {0.7, 0.7, 0.7}, {1e-20, 1e-20, 1e-20}));
  EXPECT_FALSE(are_collinear({0.1, 0.1, 0.1}, {0.7, 0.7, 0.7}, {1e-20, 1e-20, 1.1e-20}));
  EXPECT_FALSE(are_collinear({0, 0, 0}, {0, 0, 1}, {1e-30, 0, 0}));
}

}  // namespace
}  // namespace tessera::delaunay
