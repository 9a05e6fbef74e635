// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/predict/schedule.hpp"

#include <algorithm>
#include <chrono>
#include <functional>
#include <numeric>
#include <vector>

#include <gtest/gtest.h>

namespace tessera::pipeline {
namespace {

// Durations without a pattern, the largest first, as jobs are handed out.
std::vector<double> spread_jobs(std::size_t count)
{
  std::vector<double> job_s(count);
  for (std::size_t i = 0; i < count; ++i) {
    job_s[i] = 1.0 + static_cast<double>(i * 7919 % 1009) / 100.0;
  }
  std::ranges::sort(job_s, std::greater<>());
  return job_s;
}

double sum(const std::vector<double>& job_s)
{
  return std::accumulate(job_s.begin(), job_s.end(), 0.0);
}

TEST(Schedule, OneWorkerDoesOneAfterTheOther)
{
  const auto job_s = spread_jobs(37);
  const Schedule schedule = simulate_schedule(job_s, 1);
  EXPECT_DOUBLE_EQ(schedule.makespan_s, sum(job_s));
  EXPECT_DOUBLE_EQ(schedule.work_s, sum(job_s));
  EXPECT_DOUBLE_EQ(schedule.busy_share, 1.0);
}

TEST(Schedule, HandsEachJobToTheFirstFreeWorker)
{
  // Ends: 4; 3; 3 + 3; 4 + 2; 6 + 1.
  const Schedule schedule = simulate_schedule({4.0, 3.0, 3.0, 2.0, 1.0}, 2);
  EXPECT_DOUBLE_EQ(schedule.makespan_s, 7.0);
  EXPECT_DOUBLE_EQ(schedule.busy_share, 13.0 / 14.0);
  // The order of the list counts: the long job comes last and finds both at work.
  EXPECT_DOUBLE_EQ(simulate_schedule({1.0, 1.0, 4.0}, 2).makespan_s, 5.0);
}

TEST(Schedule, AsManyWorkersAsJobsTakeTheLongestJob)
{
  const auto job_s = spread_jobs(50);
  for (const int workers : {50, 51, 100'000}) {
    const Schedule schedule = simulate_schedule(job_s, workers);
    EXPECT_DOUBLE_EQ(schedule.makespan_s, job_s.front());
    EXPECT_DOUBLE_EQ(schedule.busy_share, sum(job_s) / (workers * job_s.front()));
  }
}

TEST(Schedule, LargestFirstStaysWithinFourThirdsOfTheBest)
{
  const auto job_s = spread_jobs(211);
  for (int workers = 1; workers <= 300; ++workers) {
    const double makespan_s = simulate_schedule(job_s, workers).makespan_s;
    // No schedule is shorter than this; largest-first exceeds the best by a third at most.
    const double bound_s = std::max(sum(job_s) / workers, job_s.front());
    EXPECT_GE(makespan_s, bound_s * (1.0 - 1e-12));
    EXPECT_LE(makespan_s, sum(job_s) / workers + job_s.front());
    if (workers > 40) continue;  // Few jobs a worker: the best is longer than the bound.
    EXPECT_LE(makespan_s, 4.0 / 3.0 * bound_s) << workers;
  }
}

TEST(Schedule, MoreWorkersAreNotSlower)
{
  const auto job_s = spread_jobs(300);
  double before_s = sum(job_s);
  for (int workers = 2; workers <= 512; workers *= 2) {
    const double makespan_s = simulate_schedule(job_s, workers).makespan_s;
    EXPECT_LE(makespan_s, before_s) << workers;
    before_s = makespan_s;
  }
}

TEST(Schedule, NothingToDoTakesNoTime)
{
  const Schedule schedule = simulate_schedule({}, 3);
  EXPECT_EQ(schedule.makespan_s, 0.0);
  EXPECT_EQ(schedule.busy_share, 1.0);
}

TEST(Schedule, ManyJobsOnManyWorkersAreSimulatedAtOnce)
{
  const auto job_s = spread_jobs(100'000);
  const auto start = std::chrono::steady_clock::now();
  double total_s = 0.0;
  for (const int workers : {1, 1000, 99'999, 100'000}) {
    total_s += simulate_schedule(job_s, workers).makespan_s;
  }
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
  EXPECT_GT(total_s, sum(job_s));
  EXPECT_LT(took.count(), 4.0);
}

}  // namespace
}  // namespace tessera::pipeline
