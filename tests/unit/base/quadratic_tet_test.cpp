// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/base/quadratic_tet.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace tessera {
namespace {

QuadraticTet straight_tet()
{
  QuadraticTet tet{{{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}};
  for (std::size_t e = 0; e < 6; ++e) {
    const auto [a, b] = kQuadraticTetEdges[e];
    tet[4 + e] = midpoint(tet[a], tet[b]);
  }
  return tet;
}

// By the shape functions, not by the coefficients that are tested.
double determinant_at(const QuadraticTet& tet, const std::array<double, 4>& l)
{
  constexpr std::array<Vec3, 4> kGradients{
      {{-1.0, -1.0, -1.0}, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}};
  std::array<Vec3, 3> columns{};
  const auto add = [&](const Vec3& node, const Vec3& gradient) {
    for (std::size_t k = 0; k < 3; ++k) columns[k] = columns[k] + gradient[k] * node;
  };
  for (std::size_t c = 0; c < 4; ++c) add(tet[c], (4.0 * l[c] - 1.0) * kGradients[c]);
  for (std::size_t e = 0; e < 6; ++e) {
    const auto [a, b] = kQuadraticTetEdges[e];
    add(tet[4 + e], (4.0 * l[a]) * kGradients[b] + (4.0 * l[b]) * kGradients[a]);
  }
  return dot(cross(columns[0], columns[1]), columns[2]);
}

struct Sampled {
  double smallest = 1e300;
  double largest = -1e300;
};

Sampled sample(const QuadraticTet& tet, int n)
{
  Sampled found;
  for (int i = 0; i <= n; ++i) {
    for (int j = 0; i + j <= n; ++j) {
      for (int k = 0; i + j + k <= n; ++k) {
        const double value = determinant_at(
            tet, {1.0 - double(i + j + k) / n, double(i) / n, double(j) / n, double(k) / n});
        found.smallest = std::min(found.smallest, value);
        found.largest = std::max(found.largest, value);
      }
    }
  }
  return found;
}

QuadraticTet random_tet(std::mt19937& random, double amplitude)
{
  std::uniform_real_distribution<double> shift(-amplitude, amplitude);
  QuadraticTet tet = straight_tet();
  for (Vec3& node : tet) {
    for (double& x : node) x += shift(random);
  }
  return tet;
}

TEST(QuadraticTet, AStraightTetHasTheConstantJacobianOfItsVolume)
{
  const QuadraticTet tet = straight_tet();
  EXPECT_TRUE(is_straight(tet));
  for (const double c : jacobian_coefficients(tet)) EXPECT_DOUBLE_EQ(c, 1.0);
  EXPECT_DOUBLE_EQ(curved_volume(tet), 1.0 / 6.0);
  const JacobianBounds bounds = jacobian_bounds(tet);
  EXPECT_EQ(bounds.smallest, bounds.largest);
  EXPECT_DOUBLE_EQ(bounds.scaled_jacobian(), 1.0);
}

TEST(QuadraticTet, ANodeShiftedAlongItsEdgeHasTheJacobianReckonedByHand)
{
  // x = r + 4 s r (1 - r - t - u) on the edge from corner 0 to 1, with r, t, u the coordinates: the
  // determinant is 1 + 4 s (1 - 2 r - t - u), between 1 - 4 s and 1 + 4 s.
  QuadraticTet tet = straight_tet();
  tet[4][0] += 0.125;
  EXPECT_FALSE(is_straight(tet));
  const JacobianCoefficients c = jacobian_coefficients(tet);
  EXPECT_NEAR(*std::ranges::min_element(c), 0.5, 1e-15);
  EXPECT_NEAR(*std::ranges::max_element(c), 1.5, 1e-15);
  EXPECT_NEAR(jacobian_bounds(tet).scaled_jacobian(), 1.0 / 3.0, 1e-12);
  // The mean of 1 - 2 r - t - u over the tet is 0.
  EXPECT_NEAR(curved_volume(tet), 1.0 / 6.0, 1e-15);
}

TEST(QuadraticTet, ANodeAtAQuarterOfItsEdgeIsNotValid)
{
  QuadraticTet tet = straight_tet();
  tet[4][0] = 0.25;
  EXPECT_FALSE(jacobian_bounds(tet).is_positive());
  tet[4][0] = 0.2501;
  EXPECT_TRUE(jacobian_bounds(tet).is_positive());
  tet[4][0] = 0.2499;
  EXPECT_FALSE(jacobian_bounds(tet).is_positive());
}

TEST(QuadraticTet, AnInvertedTetIsNotValid)
{
  QuadraticTet tet = straight_tet();
  for (Vec3& node : tet) node[2] = -node[2];
  EXPECT_FALSE(jacobian_bounds(tet).is_positive());
  tet[7][0] += 0.01;
  EXPECT_FALSE(jacobian_bounds(tet).is_positive());
}

TEST(QuadraticTet, CoefficientsGiveTheDeterminantEverywhere)
{
  std::mt19937 random(7);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  constexpr std::array<double, 4> kFactorial{1.0, 1.0, 2.0, 6.0};
  for (int trial = 0; trial < 200; ++trial) {
    const QuadraticTet tet = random_tet(random, 0.4);
    std::array<double, 4> l{share(random), share(random), share(random), share(random)};
    const double sum = l[0] + l[1] + l[2] + l[3];
    for (double& one : l) one /= sum;
    const JacobianCoefficients c = jacobian_coefficients(tet);
    double value = 0.0;
    for (std::size_t row = 0; row < c.size(); ++row) {
      double term = 6.0 * c[row];
      for (std::size_t i = 0; i < 4; ++i) {
        const int e = cubic_indices()[row][i];
        term *= std::pow(l[i], e) / kFactorial[static_cast<std::size_t>(e)];
      }
      value += term;
    }
    EXPECT_NEAR(value, determinant_at(tet, l), 1e-11);
  }
}

// Tets of which some are valid, some not, and many only just the one or the other.
TEST(QuadraticTet, BoundsHoldForRandomTetsAtAllSamplesAndAreSharp)
{
  std::mt19937 random(11);
  constexpr int kSamples = 16;
  int num_positive = 0;
  int num_undecided = 0;
  for (int trial = 0; trial < 4000; ++trial) {
    const double amplitude = 0.02 + 0.0002 * (trial % 1500);
    const QuadraticTet tet = random_tet(random, amplitude);
    const JacobianBounds bounds = jacobian_bounds(tet);
    const Sampled sampled = sample(tet, kSamples);
    EXPECT_LE(bounds.smallest, sampled.smallest);
    EXPECT_GE(bounds.largest, sampled.largest);
    double largest = 0.0;
    for (const double c : jacobian_coefficients(tet)) largest = std::max(largest, std::abs(c));
    EXPECT_NEAR(bounds.smallest, sampled.smallest, 0.05 * largest);
    EXPECT_NEAR(bounds.largest, sampled.largest, 0.05 * largest);
    if (bounds.is_positive()) ++num_positive;
    if (!bounds.is_positive() && sampled.smallest > 0.0) ++num_undecided;
  }
  EXPECT_GT(num_positive, 500);
  EXPECT_LT(num_positive, 3500);
  EXPECT_LT(num_undecided, 40);  // Their least value lies between the samples.
}

TEST(QuadraticTet, CoefficientsAloneWouldRefuseTetsThatCutsShowToBeValid)
{
  std::mt19937 random(13);
  int num_saved = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    const QuadraticTet tet = random_tet(random, 0.12);
    const JacobianCoefficients c = jacobian_coefficients(tet);
    if (*std::ranges::min_element(c) <= 0.0 && jacobian_bounds(tet).is_positive()) ++num_saved;
  }
  EXPECT_GT(num_saved, 0);
}

TEST(QuadraticTet, DecidesTheSameAtEveryScale)
{
  std::mt19937 random(17);
  for (int trial = 0; trial < 300; ++trial) {
    const QuadraticTet tet = random_tet(random, 0.15);
    for (const double scale : {0x1p-40, 0x1p40}) {
      QuadraticTet scaled = tet;
      for (Vec3& node : scaled) node = scale * node;
      EXPECT_EQ(jacobian_bounds(scaled).is_positive(), jacobian_bounds(tet).is_positive());
    }
  }
}

TEST(QuadraticTet, TheVolumeIsThatOfItsFaces)
{
  // The node between corners 1 and 2 moves within the face z = 0, so only the face x + y + z = 1
  // bulges: by 4 l1 l2 (h, h, 0), which has the mean 1/3 over that face of area vector (1, 1, 1)/2.
  QuadraticTet tet = straight_tet();
  const double h = 0.01;
  tet[5] = tet[5] + Vec3{h, h, 0.0};
  EXPECT_NEAR(curved_volume(tet), 1.0 / 6.0 + h / 3.0, 1e-15);
}

}  // namespace
}  // namespace tessera
