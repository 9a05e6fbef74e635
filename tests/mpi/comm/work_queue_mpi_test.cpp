// SPDX-License-Identifier: BSD-3-Clause
#include <chrono>
#include <cstdint>
#include <numeric>
#include <stdexcept>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "tessera/comm/work_queue.hpp"

namespace tessera::comm {
namespace {

using std::chrono::milliseconds;
using Clock = std::chrono::steady_clock;

std::vector<LocalIndex> items(LocalIndex count)
{
  std::vector<LocalIndex> order(static_cast<std::size_t>(count));
  std::iota(order.rbegin(), order.rend(), 0);
  return order;
}

// Works for a while as a rank does that waits for a job. Returns false if a stop came meanwhile.
bool work(WorkQueue& queue, milliseconds duration)
{
  const auto end = Clock::now() + duration;
  while (Clock::now() < end) {
    if (!queue.progress()) return false;
    std::this_thread::sleep_for(milliseconds(1));
  }
  return true;
}

void expect_each_once(const Communicator& comm, std::vector<GlobalIndex> times_done)
{
  comm.sum_in_place(times_done);
  EXPECT_EQ(times_done, std::vector<GlobalIndex>(times_done.size(), 1));
}

void run_all(LocalIndex count)
{
  const Communicator comm(MPI_COMM_WORLD);
  WorkQueue queue(comm, items(count));
  std::vector<GlobalIndex> times_done(static_cast<std::size_t>(count), 0);
  while (const auto item = queue.next()) {
    ++times_done[static_cast<std::size_t>(*item)];
    work(queue, milliseconds(*item % 3));
  }
  EXPECT_FALSE(queue.finish());
  expect_each_once(comm, times_done);
}

TEST(WorkQueue, HandsOutEveryItemOnce) { run_all(100); }

TEST(WorkQueue, FewerItemsThanRanks)
{
  run_all(0);
  run_all(1);
  run_all(2);
}

TEST(WorkQueue, OneRankAloneGetsTheItemsInTheGivenOrder)
{
  const Communicator comm(MPI_COMM_WORLD);
  WorkQueue queue(comm, {4, 2, 9});
  std::vector<LocalIndex> order;
  const bool works = comm.rank() == comm.size() - 1;
  if (works) {
    while (const auto item = queue.next()) order.push_back(*item);
  }
  queue.finish();
  EXPECT_EQ(order, works ? (std::vector<LocalIndex>{4, 2, 9}) : std::vector<LocalIndex>{});
}

TEST(WorkQueue, WorkerThatSleepsDoesNotStallTheOthers)
{
  const Communicator comm(MPI_COMM_WORLD);
  const bool sleeps = comm.size() > 1 && comm.rank() == comm.size() - 1;
  constexpr milliseconds kSleep(1500);
  std::vector<GlobalIndex> times_done(40, 0);
  comm.barrier();
  const auto start = Clock::now();
  WorkQueue queue(comm, items(40));
  while (const auto item = queue.next()) {
    ++times_done[static_cast<std::size_t>(*item)];
    if (sleeps)
      std::this_thread::sleep_for(kSleep);
    else
      work(queue, milliseconds(2));
  }
  EXPECT_TRUE(sleeps || Clock::now() - start < kSleep);
  queue.finish();
  expect_each_once(comm, times_done);
}

TEST(WorkQueue, LongJobOfRankZeroDoesNotStallTheOthers)
{
  const Communicator comm(MPI_COMM_WORLD);
  constexpr milliseconds kLong(1500);
  comm.barrier();
  const auto start = Clock::now();
  WorkQueue queue(comm, items(40));
  if (comm.rank() == 0 && queue.next()) work(queue, kLong);
  while (queue.next()) work(queue, milliseconds(2));
  EXPECT_TRUE(comm.rank() == 0 || Clock::now() - start < kLong);
  queue.finish();
}

TEST(WorkQueue, StopOfAnyRankReachesAllInTheMiddleOfTheirJobs)
{
  const Communicator comm(MPI_COMM_WORLD);
  for (Rank stopper = 0; stopper < comm.size(); ++stopper) {
    WorkQueue queue(comm, items(1000));
    const auto start = Clock::now();
    while (queue.next()) {
      if (comm.rank() == stopper)
        queue.request_stop();
      else
        EXPECT_FALSE(work(queue, std::chrono::seconds(20)));
    }
    EXPECT_FALSE(queue.next());
    EXPECT_TRUE(queue.finish());
    EXPECT_TRUE(queue.finish());
    EXPECT_LT(Clock::now() - start, std::chrono::seconds(10));
  }
}

TEST(WorkQueue, StopReachesRanksThatAreAlreadyDone)
{
  const Communicator comm(MPI_COMM_WORLD);
  WorkQueue queue(comm, {});
  if (comm.rank() == comm.size() - 1) {
    std::this_thread::sleep_for(milliseconds(50));
    queue.request_stop();
  }
  EXPECT_TRUE(queue.finish());
}

TEST(WorkQueue, ExceptionOnOneRankLetsTheOthersFinish)
{
  const Communicator comm(MPI_COMM_WORLD);
  for (Rank thrower = 0; thrower < comm.size(); ++thrower) {
    GlobalIndex num_done = 0;
    try {
      WorkQueue queue(comm, items(30));
      while (queue.next()) {
        ++num_done;
        if (comm.rank() == thrower) throw std::runtime_error("one rank only");
      }
    } catch (const std::runtime_error&) {
      EXPECT_EQ(comm.rank(), thrower);
    }
    EXPECT_EQ(comm.sum(num_done), comm.size() > 1 ? 30 : 1);
  }
}

TEST(WorkQueue, QueuesBehindEachOtherDoNotMix)
{
  for (int i = 0; i < 10; ++i) run_all(7);
}

}  // namespace
}  // namespace tessera::comm
