// SPDX-License-Identifier: BSD-3-Clause
#include "check/piece/quality.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

namespace tessera::check {
namespace {

constexpr std::array<Vec3, 4> kRegular{
    {{1.0, 1.0, 1.0}, {-1.0, 1.0, -1.0}, {1.0, -1.0, -1.0}, {-1.0, -1.0, 1.0}}};

QualityFigures figures_of(const std::array<Vec3, 4>& corners)
{
  ShapeSums sums;
  MeanRatioCounts counts;
  const TetShape shape = shape_of(corners);
  sums.add(shape);
  counts.add(shape.mean_ratio);
  return quality_figures(sums, counts);
}

TEST(CheckQuality, RegularTetHasMeanRatioOneAndOneAngle)
{
  const QualityFigures figures = figures_of(kRegular);
  EXPECT_NEAR(figures.mean_ratio_min, 1.0, 1e-14);
  EXPECT_NEAR(figures.min_dihedral_deg, 70.528779365509308, 1e-9);
  EXPECT_NEAR(figures.max_dihedral_deg, 70.528779365509308, 1e-9);
  EXPECT_EQ(figures.mean_ratio_histogram.back(), 1);
}

TEST(CheckQuality, CornerOfACubeHasItsKnownAngles)
{
  const QualityFigures figures =
      figures_of({{{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}});
  EXPECT_NEAR(figures.min_dihedral_deg, std::acos(1.0 / std::sqrt(3.0)) * 180.0 / std::numbers::pi,
              1e-9);
  EXPECT_NEAR(figures.max_dihedral_deg, 90.0, 1e-9);
  EXPECT_NEAR(figures.mean_ratio_min, 12.0 * std::pow(0.5, 2.0 / 3.0) / 9.0, 1e-14);
}

TEST(CheckQuality, DoesNotChangeUnderEvenPermutationsAndScaling)
{
  const std::array<Vec3, 4> corners{
      {{0.0, 0.0, 0.0}, {1.0, 0.1, 0.0}, {0.2, 2.0, 0.0}, {0.3, 0.1, 3.0}}};
  const TetShape shape = shape_of(corners);
  const TetShape turned =
      shape_of({1e-3 * corners[1], 1e-3 * corners[2], 1e-3 * corners[0], 1e-3 * corners[3]});
  EXPECT_NEAR(shape.mean_ratio, turned.mean_ratio, 1e-14);
  EXPECT_NEAR(shape.min_dihedral_cosine, turned.min_dihedral_cosine, 1e-14);
  EXPECT_NEAR(shape.max_dihedral_cosine, turned.max_dihedral_cosine, 1e-14);
}

TEST(CheckQuality, FlatAndInvertedTetsHaveMeanRatioZero)
{
  EXPECT_EQ(shape_of({kRegular[1], kRegular[0], kRegular[2], kRegular[3]}).mean_ratio, 0.0);
  const std::array<Vec3, 4> flat{
      {{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {1.0, 1.0, 0.0}, {0.0, 1.0, 0.0}}};
  EXPECT_EQ(shape_of(flat).mean_ratio, 0.0);
  EXPECT_NEAR(figures_of(flat).max_dihedral_deg, 180.0, 1e-9);
}

TEST(CheckQuality, NoTetsGiveZeros)
{
  const QualityFigures figures = quality_figures({}, {});
  EXPECT_EQ(figures.mean_ratio_min, 0.0);
  EXPECT_EQ(figures.max_dihedral_deg, 0.0);
}

TEST(CheckQuality, PercentilesOfEdgeLengthsAreWithinHalfAPercent)
{
  for (const double scale : {1e-9, 1.0, 7e5}) {
    EdgeLengths lengths;
    for (int i = 1; i <= 1000; ++i) lengths.add(scale * i);
    const EdgeLengthFigures figures = lengths.figures();
    EXPECT_NEAR(figures.p01, 10.0 * scale, 0.05 * scale);
    EXPECT_NEAR(figures.median, 500.0 * scale, 2.5 * scale);
    EXPECT_NEAR(figures.p99, 990.0 * scale, 5.0 * scale);
  }
}

TEST(CheckQuality, LengthsThatAreNoNumbersAreLeftOut)
{
  EdgeLengths lengths;
  lengths.add(std::numeric_limits<double>::quiet_NaN());
  lengths.add(0.0);
  EXPECT_EQ(lengths.figures().median, 0.0);
  lengths.add(std::numeric_limits<double>::max());
  EXPECT_GT(lengths.figures().median, 1e70);
}

}  // namespace
}  // namespace tessera::check
