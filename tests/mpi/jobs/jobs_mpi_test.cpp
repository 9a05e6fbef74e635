// SPDX-License-Identifier: BSD-3-Clause
// Worker processes under MPI, as the program uses them: forked before MPI_Init, jobs handed out by
// a work queue that is served while a rank waits for its own job.
#include <chrono>
#include <csignal>
#include <memory>
#include <numeric>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tessera/comm/work_queue.hpp"
#include "tessera/jobs/job_runner.hpp"

#include "support/failing_worker.hpp"
#include "support/mpi_tests.hpp"

namespace tessera::jobs {
namespace {

using ::tessera::testing::bytes_of;
using ::tessera::testing::FailingWorker;
using ::tessera::testing::text_of;
using Clock = std::chrono::steady_clock;

JobRunner* runner_of_this_rank = nullptr;

JobOutcome run(const std::string& command, const JobRunner::WaitCallback& on_wait = {})
{
  return runner_of_this_rank->run(bytes_of(command), {.cpu_s = 60.0}, on_wait);
}

TEST(JobsUnderMpi, FailuresOfJobsLeaveTheRankAlone)
{
  const comm::Communicator comm(MPI_COMM_WORLD);
  EXPECT_EQ(run("segfault").code, SIGSEGV);
  EXPECT_EQ(run("exit 3").code, 3);
  EXPECT_EQ(run("throw mesh").error, ErrorKind::mesh);
  EXPECT_EQ(run("zeros 8").result.size(), std::size_t{8} << 20);
  EXPECT_EQ(comm.sum(1), comm.size());
}

TEST(JobsUnderMpi, EveryRankHasItsOwnModel)
{
  const comm::Communicator comm(MPI_COMM_WORLD);
  const std::string mine = "rank" + std::to_string(comm.rank());
  EXPECT_EQ(runner_of_this_rank->load(bytes_of("segfault"), {}, {}).status, JobStatus::crashed);
  EXPECT_EQ(runner_of_this_rank->load(bytes_of("append " + mine), {}, {}).status, JobStatus::ok);
  EXPECT_EQ(text_of(run("get").result), mine);
  comm.barrier();
}

TEST(JobsUnderMpi, RanksOfANodeShareAModel)
{
  const comm::Communicator comm(MPI_COMM_WORLD);
  std::string name;
  if (comm.rank() == 0) name = runner_of_this_rank->open_to_node();
  name = from_bytes<std::string>(comm.broadcast(to_bytes(name), 0));
  if (comm.rank() != 0) runner_of_this_rank->join(name);
  comm.barrier();
  if (comm.rank() == 0) runner_of_this_rank->close_to_node();

  EXPECT_EQ(runner_of_this_rank->load(bytes_of("append once"), {}, {}).status, JobStatus::ok);
  comm.barrier();
  for (int round = 0; round < 20; ++round) {
    EXPECT_EQ(run("segfault").code, SIGSEGV);
    EXPECT_EQ(text_of(run("get").result), "once");
  }
  comm.barrier();
  runner_of_this_rank->leave_node();
  EXPECT_EQ(text_of(run("get").result), "");
}

TEST(JobsUnderMpi, QueueIsServedWhileRanksWaitForJobs)
{
  const comm::Communicator comm(MPI_COMM_WORLD);
  std::vector<LocalIndex> order(40);
  std::iota(order.begin(), order.end(), 0);
  std::vector<GlobalIndex> times_done(order.size(), 0);
  comm::WorkQueue queue(comm, order);
  while (const auto item = queue.next()) {
    const std::string command = *item % 5 == 0 ? "segfault" : "get";
    const JobOutcome outcome = run(command, [&] { return queue.progress(); });
    EXPECT_EQ(outcome.status, *item % 5 == 0 ? JobStatus::crashed : JobStatus::ok);
    ++times_done[static_cast<std::size_t>(*item)];
  }
  EXPECT_FALSE(queue.finish());
  comm.sum_in_place(times_done);
  EXPECT_EQ(times_done, std::vector<GlobalIndex>(order.size(), 1));
}

TEST(JobsUnderMpi, StopOfOneRankCancelsTheJobsOfAll)
{
  const comm::Communicator comm(MPI_COMM_WORLD);
  comm::WorkQueue queue(comm, std::vector<LocalIndex>(100, 0));
  const auto start = Clock::now();
  const bool stops = comm.rank() == comm.size() - 1;
  while (queue.next()) {
    const JobOutcome outcome = run("sleep", [&] {
      if (stops && Clock::now() - start > std::chrono::milliseconds(100)) queue.request_stop();
      return queue.progress();
    });
    EXPECT_EQ(outcome.status, JobStatus::cancelled);
  }
  EXPECT_TRUE(queue.finish());
  EXPECT_LT(Clock::now() - start, std::chrono::seconds(10));
  EXPECT_EQ(run("get").status, JobStatus::ok);
}

}  // namespace
}  // namespace tessera::jobs

int main(int argc, char** argv)
{
  auto runner = std::make_unique<tessera::jobs::JobRunner>(
      [] { return std::make_unique<tessera::testing::FailingWorker>(); });
  tessera::jobs::runner_of_this_rank = runner.get();

  MPI_Init(&argc, &argv);
  const int failed = tessera::testing::run_tests_on_all_ranks(argc, argv);
  runner.reset();
  MPI_Finalize();
  return failed;
}
