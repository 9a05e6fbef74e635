// SPDX-License-Identifier: BSD-3-Clause
#include "jobs/watch.hpp"

#include <optional>

#include <gtest/gtest.h>

namespace tessera::jobs {
namespace {

constexpr JobLimits kLimits{.cpu_s = 10.0, .stall_s = 3.0, .memory_gib = 1.0};

ProcessSample sample(double cpu_s, std::size_t rss_mib = 10, bool runnable = false)
{
  return {.cpu_s = cpu_s, .rss_bytes = rss_mib << 20, .runnable = runnable};
}

TEST(Watch, LetsAProcessWithinItsLimitsRun)
{
  Watch watch(kLimits, 0.0);
  for (int look = 1; look < 90; ++look)
    EXPECT_EQ(watch.look(sample(0.1 * look, 1024), 0.1), std::nullopt);
}

TEST(Watch, CountsCpuTimeFromTheStartOfTheWork)
{
  Watch watch(kLimits, 100.0);
  EXPECT_EQ(watch.look(sample(109.0), 0.1), std::nullopt);
  EXPECT_DOUBLE_EQ(watch.cpu_s(), 9.0);
  EXPECT_EQ(watch.look(sample(110.5), 0.1), JobStatus::out_of_time);
}

TEST(Watch, FindsMemoryAboveTheLimit)
{
  Watch watch(kLimits, 0.0);
  EXPECT_EQ(watch.look(sample(0.1, 1025), 0.1), JobStatus::out_of_memory);
  EXPECT_EQ(watch.peak_rss_bytes(), std::size_t{1025} << 20);
}

TEST(Watch, FindsSleepers)
{
  Watch watch(kLimits, 0.0);
  EXPECT_EQ(watch.look(sample(1.0), 0.5), std::nullopt);
  for (int look = 0; look < 6; ++look) EXPECT_EQ(watch.look(sample(1.0), 0.5), std::nullopt);
  EXPECT_EQ(watch.look(sample(1.0), 0.5), JobStatus::stalled);
}

TEST(Watch, AProcessThatCannotBeLookedAtSleeps)
{
  Watch watch(kLimits, 0.0);
  for (int look = 0; look < 6; ++look) EXPECT_EQ(watch.look(std::nullopt, 0.5), std::nullopt);
  EXPECT_EQ(watch.look(std::nullopt, 0.5), JobStatus::stalled);
}

TEST(Watch, WaitingForACoreIsNoSleep)
{
  Watch watch(kLimits, 0.0);
  for (int look = 0; look < 100; ++look)
    EXPECT_EQ(watch.look(sample(1.0, 10, true), 0.5), std::nullopt);
}

TEST(Watch, WorkInBetweenStartsTheStallAnew)
{
  Watch watch(kLimits, 0.0);
  for (int look = 0; look < 100; ++look) {
    const int hundredths = look / 4;
    EXPECT_EQ(watch.look(sample(0.01 * hundredths), 0.7), std::nullopt);
  }
}

TEST(Watch, TimeInWhichNobodyLookedProvesLittle)
{
  Watch watch(kLimits, 0.0);
  EXPECT_EQ(watch.look(sample(1.0), 0.1), std::nullopt);
  EXPECT_EQ(watch.look(sample(1.0), 3600.0), std::nullopt);
}

constexpr JobLimits kWithProgress{
    .cpu_s = 1000.0, .stall_s = 3.0, .memory_gib = 1.0, .idle_cpu_s = 5.0};

TEST(Watch, CpuTimeWithoutProgressIsAStall)
{
  Watch watch(kWithProgress, 0.0);
  EXPECT_EQ(watch.look(sample(4.0), 4.0), std::nullopt);
  watch.note_progress();
  EXPECT_EQ(watch.look(sample(8.9), 4.9), std::nullopt);
  EXPECT_FALSE(watch.is_idle());
}

TEST(Watch, AJobThatSaysNothingIsGivenUp)
{
  Watch watch(kWithProgress, 0.0);
  EXPECT_EQ(watch.look(sample(5.1), 5.1), JobStatus::stalled);
  EXPECT_TRUE(watch.is_idle());
  EXPECT_DOUBLE_EQ(watch.cpu_without_s(), 5.1);
}

TEST(Watch, WhoTakesLongStepsMayTakeLongerOnes)
{
  Watch watch(kWithProgress, 0.0);
  static_cast<void>(watch.look(sample(4.0), 4.0));
  watch.note_progress();
  EXPECT_EQ(watch.look(sample(43.0), 39.0), std::nullopt);
  EXPECT_EQ(watch.look(sample(44.1), 1.1), JobStatus::stalled);
}

TEST(Watch, ProgressCountsOnlyWhereItIsWatched)
{
  Watch watch({.cpu_s = 1000.0}, 0.0);
  EXPECT_EQ(watch.look(sample(900.0), 900.0), std::nullopt);
}

}  // namespace
}  // namespace tessera::jobs
