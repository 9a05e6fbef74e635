// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/quality/statistics.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include <gtest/gtest.h>

#include "tessera/base/bytes.hpp"
#include "tessera/base/error.hpp"

namespace tessera::quality {
namespace {

// Values that no formula makes even, in [0, 1).
double value(int i) { return std::fmod(0.618033988749895 * i, 1.0); }

TEST(Histogram, CountsLowerBoundsInTheirBinAndTheUpperEndInTheLast)
{
  Histogram histogram(0.0, 1.0, 4);
  for (const double x : {0.0, 0.25, 0.5, 0.75, 1.0}) histogram.add(x);
  EXPECT_EQ(histogram.counts(), (std::vector<GlobalIndex>{1, 1, 1, 2}));
}

TEST(Histogram, CountsWhatIsOutsideAtTheEnds)
{
  Histogram histogram(0.0, 1.0, 2);
  constexpr double kInf = std::numeric_limits<double>::infinity();
  for (const double x : {-1e-9, -1e300, -kInf, 1.0 + 1e-9, 1e300, kInf}) histogram.add(x);
  EXPECT_EQ(histogram.counts(), (std::vector<GlobalIndex>{3, 3}));
  EXPECT_EQ(histogram.total(), 6);
}

TEST(Histogram, SubtractsWhatWasAdded)
{
  Histogram histogram(0.0, 1.0, 4);
  histogram.add(0.3);
  const std::vector<GlobalIndex> before = histogram.counts();
  Histogram other(0.0, 1.0, 4);
  for (const double x : {0.1, 0.3, 0.9}) other.add(x);
  histogram.add(other);
  EXPECT_EQ(histogram.total(), 4);
  histogram.subtract(other);
  EXPECT_EQ(histogram.counts(), before);
}

TEST(Histogram, PercentilesOfNothingAreZero)
{
  EXPECT_EQ(Histogram(2.0, 3.0, 10).percentile(0.5), 0.0);
  EXPECT_EQ(Histogram(2.0, 3.0, 10).total(), 0);
}

TEST(Histogram, PercentilesOfOneValueAreItsBin)
{
  Histogram histogram(0.0, 10.0, 10);
  histogram.add(7.3);
  for (const double share : {0.0, 0.01, 0.5, 0.99, 1.0}) {
    EXPECT_DOUBLE_EQ(histogram.percentile(share), 7.5);
  }
}

TEST(Histogram, PercentilesAreThoseOfTheSortedValuesToABin)
{
  std::vector<double> values;
  Histogram histogram(0.0, 1.0, 1000);
  for (int i = 0; i < 777; ++i) {
    values.push_back(value(i) * value(i));
    histogram.add(values.back());
  }
  std::sort(values.begin(), values.end());
  for (const double share : {0.0, 0.01, 0.25, 0.5, 0.99, 1.0}) {
    const auto place = static_cast<std::size_t>(share * 776.0);
    EXPECT_NEAR(histogram.percentile(share), values[place], 0.0005 + 1e-12) << share;
  }
}

// Histogram of values 0.5, 1.5, ... taken so often.
Histogram histogram_of(const std::vector<GlobalIndex>& counts)
{
  Histogram histogram(0.0, static_cast<double>(counts.size()), counts.size());
  histogram.set_counts(counts);
  return histogram;
}

TEST(Histogram, DistanceOfAPartFromTheOthers)
{
  // Shares below: 1/2, 1/2, 1 of the part; 1/4, 3/4, 1 of the others.
  EXPECT_DOUBLE_EQ(ks_distance(histogram_of({1, 0, 1}), histogram_of({2, 2, 2})), 0.25);
  EXPECT_DOUBLE_EQ(ks_distance(histogram_of({5, 0, 0}), histogram_of({5, 0, 7})), 1.0);
  EXPECT_DOUBLE_EQ(ks_distance(histogram_of({0, 0, 5}), histogram_of({7, 0, 5})), 1.0);
  EXPECT_DOUBLE_EQ(ks_distance(histogram_of({1, 2, 3}), histogram_of({3, 6, 9})), 0.0);
}

TEST(Histogram, NothingHasNoDistance)
{
  EXPECT_EQ(ks_distance(histogram_of({0, 0}), histogram_of({3, 4})), 0.0);
  EXPECT_EQ(ks_distance(histogram_of({3, 4}), histogram_of({3, 4})), 0.0);
}

TEST(Histogram, PercentilesPassEmptyBins)
{
  Histogram histogram(0.0, 4.0, 4);
  histogram.add(0.5);
  histogram.add(3.5);
  EXPECT_DOUBLE_EQ(histogram.percentile(0.0), 0.5);
  EXPECT_DOUBLE_EQ(histogram.percentile(1.0), 3.5);
}

TEST(Histogram, CoarsenedKeepsAllCounts)
{
  Histogram fine(0.0, 1.0, 2000);
  Histogram coarse(0.0, 1.0, 20);
  for (int i = 0; i < 500; ++i) {
    fine.add(value(i));
    coarse.add(value(i));
  }
  EXPECT_EQ(fine.coarsened(20), coarse.counts());
  EXPECT_EQ(fine.coarsened(2000), fine.counts());
  EXPECT_EQ(fine.coarsened(1), (std::vector<GlobalIndex>{500}));
}

TEST(Histogram, RefusesCountsOfOtherBins)
{
  Histogram histogram(0.0, 1.0, 3);
  EXPECT_THROW(histogram.set_counts({1, 2}), InputError);
  histogram.set_counts({1, 2, 3});
  EXPECT_EQ(histogram.total(), 6);
}

QualityHistograms part(int first, int last)
{
  QualityHistograms histograms;
  for (int i = first; i < last; ++i) {
    histograms.mean_ratio.add(value(i));
    if (i % 3 == 0) histograms.seam_mean_ratio.add(value(i));
    histograms.log2_edge_length.add(20.0 * value(i) - 10.0);
  }
  return histograms;
}

TEST(QualityHistograms, MergedInAnyOrderAreTheSame)
{
  const std::vector<QualityHistograms> parts{part(0, 10), part(10, 11), part(11, 11),
                                             part(11, 300)};
  std::vector<std::size_t> order{0, 1, 2, 3};
  const Bytes want = to_bytes(part(0, 300));
  do {
    QualityHistograms all;
    for (const std::size_t i : order) all.add(parts[i]);
    EXPECT_EQ(to_bytes(all), want);
  } while (std::next_permutation(order.begin(), order.end()));
}

TEST(Histogram, AnImageWithOtherBinsIsRefused)
{
  Histogram histogram(0.0, 1.0, 10);
  histogram.set_image({.bins = {0, 9}, .counts = {4, 5}});
  EXPECT_EQ(histogram.total(), 9);
  EXPECT_EQ(histogram.counts()[9], 5);
  EXPECT_THROW(histogram.set_image({.bins = {10}, .counts = {1}}), InputError);
  EXPECT_THROW(histogram.set_image({.bins = {1, 2}, .counts = {1}}), InputError);
  EXPECT_EQ(histogram.total(), 9);
}

TEST(QualityHistograms, TellEdgesThatDifferByTwoPercentApart)
{
  QualityHistograms histograms;
  histograms.log2_edge_length.add(std::log2(0.01));
  const double below = histograms.log2_edge_length.percentile(0.5);
  QualityHistograms longer;
  longer.log2_edge_length.add(std::log2(0.0102));
  EXPECT_NEAR(std::exp2(below), 0.01, 0.01 * 0.006);
  EXPECT_GT(longer.log2_edge_length.percentile(0.5), below);
}

TEST(TetStatistics, OfNothingAreNeutral)
{
  TetStatistics all;
  EXPECT_EQ(all.mean_mean_ratio(), 0.0);
  const TetStatistics some{4, 20.0, 130.0, 0.3, 2.0};
  all.add(some);
  all.add({});
  EXPECT_EQ(all.num_tets, 4);
  EXPECT_EQ(all.min_dihedral_deg, 20.0);
  EXPECT_EQ(all.max_dihedral_deg, 130.0);
  EXPECT_EQ(all.min_mean_ratio, 0.3);
  EXPECT_EQ(all.mean_mean_ratio(), 0.5);
}

TEST(TetStatistics, TakeExtremesOverAllTets)
{
  const TetCorners regular{{{1, 1, 1}, {-1, 1, -1}, {1, -1, -1}, {-1, -1, 1}}};
  const TetCorners corner{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  Histogram histogram(0.0, 1.0, 10);
  ShapeSum sum(histogram);
  sum.add(shape_of(regular));
  sum.add(shape_of(corner));
  const TetStatistics statistics = sum.statistics();
  EXPECT_EQ(statistics.num_tets, 2);
  EXPECT_EQ(statistics.min_dihedral_deg, angle_deg(shape_of(corner).largest_cosine));
  EXPECT_EQ(statistics.max_dihedral_deg, angle_deg(shape_of(corner).smallest_cosine));
  EXPECT_EQ(statistics.min_mean_ratio, mean_ratio(corner));
  EXPECT_NEAR(statistics.mean_mean_ratio(), 0.5 * (1.0 + mean_ratio(corner)), 1e-15);
  EXPECT_EQ(histogram.counts()[8], 1);
  EXPECT_EQ(histogram.counts()[9], 1);
}

TEST(TetStatistics, OfASumOfNothingAreNeutral)
{
  Histogram histogram(0.0, 1.0, 10);
  TetStatistics all{4, 20.0, 130.0, 0.3, 2.0};
  all.add(ShapeSum(histogram).statistics());
  EXPECT_EQ(all.num_tets, 4);
  EXPECT_EQ(all.min_dihedral_deg, 20.0);
  EXPECT_EQ(all.max_dihedral_deg, 130.0);
  EXPECT_EQ(all.min_mean_ratio, 0.3);
}

TEST(Histogram, NotANumberHasAPlace)
{
  Histogram histogram(0.0, 1.0, 10);
  histogram.add(std::nan(""));
  EXPECT_EQ(histogram.total(), 1);
}

}  // namespace
}  // namespace tessera::quality
