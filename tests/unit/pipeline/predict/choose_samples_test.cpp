// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/predict/choose_samples.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include <gtest/gtest.h>

namespace tessera::pipeline {
namespace {

// 1, 2, … count times `unit_s` seconds, not sorted.
std::vector<double> costs(std::size_t count, double unit_s)
{
  std::vector<double> cost_s;
  for (std::size_t i = 0; i < count; ++i) {
    cost_s.push_back(unit_s * static_cast<double>((i + count / 3) % count + 1));
  }
  return cost_s;
}

double total(const std::vector<double>& cost_s, const SampleChoice& choice, int levels)
{
  double sum_s = 0.0;
  for (const std::size_t job : choice.jobs) {
    sum_s += std::ldexp(cost_s[job], -3 * (levels - choice.levels));
  }
  return sum_s;
}

TEST(ChooseSamples, OfFewJobsTakesAll)
{
  for (const std::size_t count : {0U, 1U, 2U, 3U}) {
    const SampleChoice choice = choose_samples(costs(count, 0.1), 2);
    EXPECT_EQ(choice.jobs.size(), count);
    EXPECT_EQ(choice.levels, 2);
  }
}

TEST(ChooseSamples, NamesNoJobTwiceAndTheLargestFirst)
{
  for (std::size_t count = 1; count < 60; ++count) {
    const auto cost_s = costs(count, 0.01);
    const SampleChoice choice = choose_samples(cost_s, 2);
    const std::set<std::size_t> different(choice.jobs.begin(), choice.jobs.end());
    EXPECT_EQ(different.size(), choice.jobs.size());
    EXPECT_GE(choice.jobs.size(), std::min<std::size_t>(count, 3));
    EXPECT_LE(choice.jobs.size(), std::max<std::size_t>(3, count / 2));
    EXPECT_LE(choice.jobs.size(), 8U);
    EXPECT_EQ(cost_s[choice.jobs.front()], *std::ranges::max_element(cost_s));
  }
}

TEST(ChooseSamples, RepresentsTheMeanCost)
{
  const auto cost_s = costs(1000, 1e-3);
  const SampleChoice choice = choose_samples(cost_s, 2);
  ASSERT_EQ(choice.jobs.size(), 8U);
  EXPECT_NEAR(total(cost_s, choice, 2) / 8.0, 0.5, 0.1);
}

TEST(ChooseSamples, StaysWithinItsBudget)
{
  // 100 jobs of up to 10 s: a fifth of all would be 100 s.
  const auto long_jobs = costs(100, 0.1);
  const SampleChoice some = choose_samples(long_jobs, 3);
  EXPECT_EQ(some.levels, 3);
  EXPECT_GE(some.jobs.size(), 3U);
  EXPECT_LE(total(long_jobs, some, 3), 20.0);
}

TEST(ChooseSamples, TwoJobsInFullAreBetterThanThreeCoarserOnes)
{
  const SampleChoice choice = choose_samples(std::vector(12, 9.0), 3);
  EXPECT_EQ(choice.levels, 3);
  EXPECT_EQ(choice.jobs.size(), 2U);
}

TEST(ChooseSamples, TakesFewerLevelsWhereEvenThreeJobsAreTooLong)
{
  const auto cost_s = costs(100, 10.0);
  const SampleChoice choice = choose_samples(cost_s, 5);
  // The largest, the median and a quartile take some 1750 s: 27 s with two levels less.
  EXPECT_EQ(choice.levels, 2);
  EXPECT_GE(choice.jobs.size(), 3U);
  EXPECT_LE(total(cost_s, choice, 5), 20.0);
  // There is nothing coarser than the coarse mesh itself.
  EXPECT_EQ(choose_samples(costs(100, 1e9), 1).levels, 0);
}

}  // namespace
}  // namespace tessera::pipeline
