// SPDX-License-Identifier: BSD-3-Clause
// Runners that use one model zygote, as ranks of a node do.
#include <chrono>
#include <csignal>
#include <fstream>
#include <memory>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>
#include <sched.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tessera/base/error.hpp"
#include "tessera/jobs/job_runner.hpp"

#include "support/failing_worker.hpp"

namespace tessera::jobs {
namespace {

using std::chrono::milliseconds;
using ::tessera::testing::bytes_of;
using ::tessera::testing::FailingWorker;
using ::tessera::testing::text_of;
using Clock = std::chrono::steady_clock;

class JoinedRunners : public ::testing::Test {
 protected:
  static JobRunner make()
  {
    return JobRunner([] { return std::make_unique<FailingWorker>(); });
  }

  void join() { guest_.join(host_.open_to_node()); }

  static JobOutcome load(JobRunner& runner, const std::string& command,
                         const JobLimits& limits = {})
  {
    return runner.load(bytes_of(command), limits, {});
  }

  static std::string get(JobRunner& runner, const std::string& command = "get")
  {
    return text_of(runner.run(bytes_of(command), {}, {}).result);
  }

  static pid_t model_of(JobRunner& runner)
  {
    pid_t zygote = 0;
    pid_t model = 0;
    std::istringstream(get(runner, "pids")) >> zygote >> model;
    return model;
  }

  JobRunner host_{make()};
  JobRunner guest_{make()};
};

TEST_F(JoinedRunners, JobsAreForksOfOneProcess)
{
  const pid_t before = model_of(guest_);
  join();
  EXPECT_EQ(model_of(guest_), model_of(host_));
  EXPECT_NE(model_of(guest_), before);
  EXPECT_NE(::kill(before, 0), 0) << "its own one has ended";
}

TEST_F(JoinedRunners, LoadIsDoneOnceInWhateverOrderTheyAsk)
{
  join();
  EXPECT_EQ(load(host_, "append a").status, JobStatus::ok);
  EXPECT_EQ(load(guest_, "append a").status, JobStatus::ok);
  EXPECT_EQ(load(guest_, "append b").status, JobStatus::ok);
  EXPECT_EQ(load(host_, "append b").status, JobStatus::ok);
  EXPECT_EQ(get(host_), "ab");
  EXPECT_EQ(get(guest_), "ab");
}

TEST_F(JoinedRunners, WhatWasLoadedBeforeBelongsToNobody)
{
  EXPECT_EQ(load(host_, "append before").status, JobStatus::ok);
  join();
  EXPECT_EQ(load(guest_, "append a").status, JobStatus::ok);
  EXPECT_EQ(load(host_, "append a").status, JobStatus::ok);
  EXPECT_EQ(get(host_), get(guest_));
}

TEST_F(JoinedRunners, EachHearsWhyALoadFailed)
{
  join();
  for (JobRunner* const runner : {&guest_, &host_}) {
    const JobOutcome outcome = load(*runner, "throw geometry");
    EXPECT_EQ(outcome.status, JobStatus::failed);
    EXPECT_EQ(outcome.error, ErrorKind::geometry);
    EXPECT_FALSE(outcome.loads_are_lost);
  }
  EXPECT_EQ(load(host_, "append a").status, JobStatus::ok);
}

TEST_F(JoinedRunners, DifferentLoadsAreRefused)
{
  join();
  EXPECT_EQ(load(host_, "append a").status, JobStatus::ok);
  const JobOutcome outcome = load(guest_, "append b");
  EXPECT_EQ(outcome.status, JobStatus::failed);
  EXPECT_NE(outcome.message.find("different"), std::string::npos) << outcome.message;
}

TEST_F(JoinedRunners, FailuresOfJobsStayWithTheirRunner)
{
  join();
  EXPECT_EQ(guest_.run(bytes_of("segfault"), {}, {}).code, SIGSEGV);
  EXPECT_EQ(host_.run(bytes_of("exit 3"), {}, {}).code, 3);
  EXPECT_EQ(guest_.run(bytes_of("zeros 8"), {}, {}).result.size(), std::size_t{8} << 20);
  EXPECT_EQ(guest_.run(bytes_of("loop"), {.cpu_s = 0.05}, {}).status, JobStatus::out_of_time);
  EXPECT_EQ(get(guest_), get(host_));
}

TEST_F(JoinedRunners, JobsOfBothRunAtOnce)
{
  join();
  int num_done = 0;
  const JobOutcome outcome = host_.run(bytes_of("sleep"), {}, [&] {
    EXPECT_EQ(guest_.run(bytes_of("zeros 1"), {}, {}).status, JobStatus::ok);
    EXPECT_EQ(guest_.run(bytes_of("segfault"), {}, {}).status, JobStatus::crashed);
    return ++num_done < 3;
  });
  EXPECT_EQ(outcome.status, JobStatus::cancelled);
  EXPECT_EQ(num_done, 3);
  EXPECT_EQ(get(host_), "");
}

TEST_F(JoinedRunners, ModelThatDiesIsGoneForBothUntilTheyLeave)
{
  join();
  EXPECT_EQ(load(guest_, "append a").status, JobStatus::ok);
  ::kill(model_of(host_), SIGKILL);
  for (JobRunner* const runner : {&guest_, &host_}) {
    const JobOutcome outcome = runner->run(bytes_of("get"), {}, {});
    EXPECT_EQ(outcome.status, JobStatus::crashed);
    EXPECT_EQ(outcome.code, SIGKILL);
    EXPECT_TRUE(outcome.loads_are_lost);
    EXPECT_NE(outcome.message.find("what had been loaded is lost"), std::string::npos)
        << outcome.message;
  }
  EXPECT_EQ(guest_.run(bytes_of("get"), {}, {}).status, JobStatus::crashed) << "and stays so";
  guest_.leave_node();
  host_.leave_node();
  EXPECT_EQ(load(guest_, "append own").status, JobStatus::ok);
  EXPECT_EQ(get(guest_), "own");
  EXPECT_EQ(get(host_), "");
}

TEST_F(JoinedRunners, WhoLeavesIsAlone)
{
  join();
  EXPECT_EQ(load(host_, "append a").status, JobStatus::ok);
  guest_.leave_node();
  host_.leave_node();
  EXPECT_NE(model_of(guest_), model_of(host_));
  EXPECT_EQ(get(guest_), "");
  EXPECT_EQ(get(host_), "");
  join();
  EXPECT_EQ(load(guest_, "append again").status, JobStatus::ok);
  EXPECT_EQ(load(host_, "append again").status, JobStatus::ok);
  EXPECT_EQ(get(host_), "again");
}

TEST_F(JoinedRunners, LoadThatIsKilledIsLostForBoth)
{
  join();
  const JobOutcome hosts = load(host_, "loop", {.cpu_s = 0.1});
  EXPECT_EQ(hosts.status, JobStatus::out_of_time);
  EXPECT_TRUE(hosts.loads_are_lost);
  const JobOutcome guests = load(guest_, "loop", {.cpu_s = 0.1});
  EXPECT_EQ(guests.status, JobStatus::crashed);
  EXPECT_TRUE(guests.loads_are_lost);
}

TEST_F(JoinedRunners, GuestEndsALoadThatItsHostDoesNotWatch)
{
  join();
  const JobOutcome guests = load(guest_, "loop", {.cpu_s = 0.1});
  EXPECT_EQ(guests.status, JobStatus::out_of_time);
  EXPECT_TRUE(load(host_, "append a").loads_are_lost);
}

TEST_F(JoinedRunners, CancelledLoadOfAGuestGoesOnForOthers)
{
  join();
  const JobOutcome outcome = guest_.load(bytes_of("late 1"), {}, [] { return false; });
  EXPECT_EQ(outcome.status, JobStatus::cancelled);
  EXPECT_TRUE(outcome.loads_are_lost);
  EXPECT_EQ(load(host_, "late 1").status, JobStatus::ok);
  EXPECT_EQ(load(host_, "append a").status, JobStatus::ok);
  EXPECT_EQ(get(host_), "a");
  EXPECT_TRUE(load(guest_, "append a").loads_are_lost);
  guest_.leave_node();
  EXPECT_EQ(load(guest_, "append own").status, JobStatus::ok);
}

TEST_F(JoinedRunners, NobodyJoinsThroughAClosedDoor)
{
  const std::string name = host_.open_to_node();
  host_.close_to_node();
  const pid_t own = model_of(guest_);
  EXPECT_THROW(guest_.join(name), Error);
  EXPECT_EQ(model_of(guest_), own) << "nothing has changed";
}

TEST_F(JoinedRunners, JobsCountTheirMemoryNotThatOfTheHost)
{
  join();
  EXPECT_EQ(load(host_, "keep 64").status, JobStatus::ok);
  EXPECT_EQ(load(guest_, "keep 64").status, JobStatus::ok);
  EXPECT_EQ(get(guest_), "");
  EXPECT_GT(host_.usage().loaded_bytes, std::size_t{64} << 20);
  EXPECT_LT(guest_.usage().peak_rss_bytes, std::size_t{32} << 20);
}

// A rank with a runner of its own, in another process; it joins and then works for ever.
pid_t start_guest(const std::string& name, const std::string& command,
                  const JobRunner::WaitCallback& on_wait = {})
{
  const pid_t guest = ::fork();
  if (guest != 0) return guest;
  cpu_set_t cores;
  ::sched_getaffinity(0, sizeof(cores), &cores);
  std::size_t first = 0;
  while (!CPU_ISSET(first, &cores)) ++first;
  CPU_ZERO(&cores);
  CPU_SET(first, &cores);
  ::sched_setaffinity(0, sizeof(cores), &cores);
  JobRunner runner([] { return std::make_unique<FailingWorker>(); });
  runner.join(name);
  static_cast<void>(runner.run(bytes_of(command), {}, on_wait));
  ::_exit(0);
}

// The only child of `parent`, as soon as there is one.
pid_t child_of(pid_t parent)
{
  const std::string number = std::to_string(parent);
  const auto deadline = Clock::now() + std::chrono::seconds(10);
  pid_t child = 0;
  while (child == 0 && Clock::now() < deadline) {
    std::ifstream("/proc/" + number + "/task/" + number + "/children") >> child;
    std::this_thread::sleep_for(milliseconds(2));
  }
  return child;
}

// A process takes its cores a moment after the fork.
bool is_soon_on_one_core(pid_t pid)
{
  const auto deadline = Clock::now() + std::chrono::seconds(10);
  while (Clock::now() < deadline) {
    cpu_set_t cores;
    if (::sched_getaffinity(pid, sizeof(cores), &cores) != 0) return false;
    if (CPU_COUNT(&cores) == 1) return true;
    std::this_thread::sleep_for(milliseconds(2));
  }
  return false;
}

bool ends_soon(pid_t pid)
{
  const auto deadline = Clock::now() + std::chrono::seconds(10);
  while (Clock::now() < deadline) {
    if (::kill(pid, 0) != 0) return true;
    std::this_thread::sleep_for(milliseconds(2));
  }
  return false;
}

TEST_F(JoinedRunners, JobEndsWithTheRankThatAskedForIt)
{
  const std::string name = host_.open_to_node();
  const pid_t guest = start_guest(name, "sleep");
  const pid_t job = child_of(model_of(host_));
  ASSERT_GT(job, 0);
  EXPECT_TRUE(is_soon_on_one_core(job)) << "it runs on the cores of its rank";
  ::kill(guest, SIGKILL);
  ::waitpid(guest, nullptr, 0);
  EXPECT_TRUE(ends_soon(job));
  EXPECT_EQ(get(host_), "") << "the host goes on";
}

// The job's result just fits into the socket of its rank, and then nothing else does.
TEST_F(JoinedRunners, NobodyWaitsForARankThatIsStopped)
{
  const std::string name = host_.open_to_node();
  std::vector<pid_t> guests;
  for (const int kib : {128, 192, 224, 256, 4096}) {
    guests.push_back(start_guest(name, "late " + std::to_string(kib), [] {
      ::raise(SIGSTOP);
      return true;
    }));
  }
  for (const pid_t guest : guests) {
    int status = 0;
    ::waitpid(guest, &status, WUNTRACED);
    EXPECT_TRUE(WIFSTOPPED(status));
  }
  std::this_thread::sleep_for(milliseconds(500));
  for (int i = 0; i < 10; ++i)
    EXPECT_EQ(host_.run(bytes_of("get"), {.stall_s = 5.0}, {}).status, JobStatus::ok);
  for (const pid_t guest : guests) {
    ::kill(guest, SIGKILL);
    ::waitpid(guest, nullptr, 0);
  }
  EXPECT_EQ(get(host_), "");
}

}  // namespace
}  // namespace tessera::jobs
