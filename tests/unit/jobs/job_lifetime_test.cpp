// SPDX-License-Identifier: BSD-3-Clause
// No worker process outlives its owner, and the owner outlives every worker process.
#include <array>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <string>
#include <thread>

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tessera/jobs/job_runner.hpp"

#include "support/failing_worker.hpp"
#include "support/temporary_folder.hpp"

namespace tessera::jobs {
namespace {

using std::chrono::milliseconds;
using ::tessera::testing::bytes_of;
using ::tessera::testing::FailingWorker;
using ::tessera::testing::text_of;
using Clock = std::chrono::steady_clock;

struct Family {
  pid_t zygote = 0;
  pid_t model = 0;
  pid_t job = 0;
};

std::unique_ptr<JobRunner> make_runner()
{
  return std::make_unique<JobRunner>([] { return std::make_unique<FailingWorker>(); });
}

JobOutcome run(JobRunner& runner, const std::string& command,
               const JobRunner::WaitCallback& on_wait = {})
{
  return runner.run(bytes_of(command), {}, on_wait);
}

Family family_of(JobRunner& runner)
{
  Family family;
  std::istringstream(text_of(run(runner, "pids").result)) >> family.zygote >> family.model
      >> family.job;
  return family;
}

// A zombie that its new parent was too lazy to reap has ended as well.
bool has_ended(pid_t pid)
{
  std::ifstream stat("/proc/" + std::to_string(pid) + "/stat");
  std::string number;
  std::string name;
  std::string state;
  return !(stat >> number >> name >> state) || state == "Z" || state == "X";
}

bool ends_soon(pid_t pid)
{
  const auto deadline = Clock::now() + std::chrono::seconds(5);
  while (Clock::now() < deadline) {
    if (has_ended(pid)) return true;
    std::this_thread::sleep_for(milliseconds(2));
  }
  return false;
}

std::size_t num_open_descriptors()
{
  const std::filesystem::directory_iterator open("/proc/self/fd");
  return static_cast<std::size_t>(std::distance(begin(open), end(open)));
}

// The process numbers of children of `parent`.
std::string children_of(pid_t parent)
{
  const std::string number = std::to_string(parent);
  std::ifstream file("/proc/" + number + "/task/" + number + "/children");
  std::string text;
  std::getline(file, text);
  return text;
}

// What Ctrl-C sends to all processes of the group at once.
void signal_all(const Family& family, int signal)
{
  ::kill(family.zygote, signal);
  ::kill(family.model, signal);
}

TEST(JobLifetime, TheWorkerIsMadeBeforeItIsNeededIfThatIsAskedFor)
{
  const testing::TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "made";
  JobRunner runner([file] {
    std::ofstream(file) << "now";
    return std::make_unique<FailingWorker>();
  });
  runner.prepare();
  const auto deadline = Clock::now() + std::chrono::seconds(5);
  while (!std::filesystem::exists(file) && Clock::now() < deadline) {
    std::this_thread::sleep_for(milliseconds(2));
  }
  EXPECT_TRUE(std::filesystem::exists(file));
  EXPECT_EQ(run(runner, "pids").status, JobStatus::ok);
}

TEST(JobLifetime, AWorkerThatCannotBeMadeFailsTheFirstJobAlsoIfItWasPrepared)
{
  JobRunner runner([]() -> std::unique_ptr<Worker> { throw std::runtime_error("no library"); });
  runner.prepare();
  const JobOutcome outcome = run(runner, "pids");
  EXPECT_EQ(outcome.status, JobStatus::failed);
  EXPECT_EQ(outcome.message, "no library");
}

TEST(JobLifetime, NothingIsLeftOfADestroyedRunner)
{
  const std::size_t descriptors_before = num_open_descriptors();
  auto runner = make_runner();
  const Family family = family_of(*runner);
  EXPECT_FALSE(has_ended(family.zygote));
  EXPECT_FALSE(has_ended(family.model));
  EXPECT_TRUE(has_ended(family.job));
  runner.reset();
  EXPECT_NE(::kill(family.zygote, 0), 0) << "not even a zombie";
  EXPECT_NE(::kill(family.model, 0), 0) << "not even a zombie";
  EXPECT_EQ(num_open_descriptors(), descriptors_before);
  EXPECT_EQ(children_of(::getpid()), "");
}

TEST(JobLifetime, RunnerThatWasNeverUsedEnds)
{
  for (int i = 0; i < 20; ++i) make_runner().reset();
  EXPECT_EQ(children_of(::getpid()), "");
}

TEST(JobLifetime, WorkersDieWithAnOwnerThatIsKilled)
{
  std::array<int, 2> channel{};
  ASSERT_EQ(::pipe(channel.data()), 0);
  const pid_t owner = ::fork();
  if (owner == 0) {
    const auto runner = make_runner();
    const Family family = family_of(*runner);
    (void)run(*runner, "sleep", [&] {
      std::istringstream children(children_of(family.model));
      Family now = family;
      if (children >> now.job) (void)!::write(channel[1], &now, sizeof(now));
      return true;
    });
    ::_exit(0);
  }
  Family family;
  ASSERT_EQ(::read(channel[0], &family, sizeof(family)), static_cast<ssize_t>(sizeof(family)));
  EXPECT_FALSE(has_ended(family.job));
  ::kill(owner, SIGKILL);
  ::waitpid(owner, nullptr, 0);
  ::close(channel[0]);
  ::close(channel[1]);
  EXPECT_TRUE(ends_soon(family.zygote));
  EXPECT_TRUE(ends_soon(family.model));
  EXPECT_TRUE(ends_soon(family.job));
}

TEST(JobLifetime, SignalsToTheProcessGroupLeaveTheWorkersAlone)
{
  const auto runner = make_runner();
  const Family family = family_of(*runner);
  for (const int signal : {SIGINT, SIGTERM, SIGUSR1, SIGUSR2, SIGHUP, SIGPIPE})
    signal_all(family, signal);
  const Family later = family_of(*runner);
  EXPECT_EQ(later.zygote, family.zygote);
  EXPECT_EQ(later.model, family.model);
}

TEST(JobLifetime, JobKilledFromOutsideIsACrash)
{
  const auto runner = make_runner();
  const Family family = family_of(*runner);
  const JobOutcome outcome = run(*runner, "sleep", [&] {
    pid_t job = 0;
    if (std::istringstream(children_of(family.model)) >> job) ::kill(job, SIGKILL);
    return true;
  });
  EXPECT_EQ(outcome.status, JobStatus::crashed);
  EXPECT_EQ(outcome.code, SIGKILL);
  EXPECT_EQ(family_of(*runner).model, family.model);
}

TEST(JobLifetime, ModelZygoteKilledInAJobIsACrashAndReplaced)
{
  const auto runner = make_runner();
  const Family family = family_of(*runner);
  pid_t job = 0;
  const JobOutcome outcome = run(*runner, "sleep", [&] {
    if (std::istringstream(children_of(family.model)) >> job) ::kill(family.model, SIGKILL);
    return true;
  });
  EXPECT_EQ(outcome.status, JobStatus::crashed);
  EXPECT_EQ(outcome.code, SIGKILL);
  EXPECT_NE(outcome.message.find("lost"), std::string::npos) << outcome.message;
  EXPECT_NE(::kill(job, 0), 0) << "the job is gone, too, and reaped";
  EXPECT_EQ(run(*runner, "get").status, JobStatus::ok);
  EXPECT_NE(family_of(*runner).model, family.model);
}

TEST(JobLifetime, ModelZygoteKilledBetweenCallsIsReportedOnceAndReplaced)
{
  const auto runner = make_runner();
  const Family family = family_of(*runner);
  ::kill(family.model, SIGKILL);
  EXPECT_EQ(run(*runner, "get").status, JobStatus::crashed);
  EXPECT_EQ(run(*runner, "get").status, JobStatus::ok);

  ::kill(family_of(*runner).model, SIGKILL);
  std::this_thread::sleep_for(milliseconds(50));
  EXPECT_EQ(run(*runner, "get").status, JobStatus::crashed);
  EXPECT_EQ(run(*runner, "get").status, JobStatus::ok);
}

TEST(JobLifetime, ZygoteKilledInAJobIsACrashAndSoAreAllLaterCalls)
{
  const auto runner = make_runner();
  const Family family = family_of(*runner);
  const JobOutcome outcome = run(*runner, "sleep", [&] {
    ::kill(family.zygote, SIGKILL);
    return true;
  });
  for (const JobOutcome& dead : {outcome, run(*runner, "get"), runner->load({}, {}, {})}) {
    EXPECT_EQ(dead.status, JobStatus::crashed);
    EXPECT_NE(dead.message.find("gone"), std::string::npos) << dead.message;
  }
  EXPECT_TRUE(ends_soon(family.model));
}

TEST(JobLifetime, ZygoteKilledBetweenCallsIsACrash)
{
  const auto runner = make_runner();
  const Family family = family_of(*runner);
  ::kill(family.zygote, SIGKILL);
  ASSERT_TRUE(ends_soon(family.model)) << "until then it may answer";
  EXPECT_EQ(run(*runner, "get").status, JobStatus::crashed);
  EXPECT_EQ(runner->load(bytes_of("append " + std::string(5000000, 'x')), {}, {}).status,
            JobStatus::crashed);
}

TEST(JobLifetime, StoppedModelZygoteIsFoundAndReplaced)
{
  const auto runner = make_runner();
  ::kill(family_of(*runner).model, SIGSTOP);
  const JobOutcome outcome = runner->load({}, {.stall_s = 0.2}, {});
  EXPECT_EQ(outcome.status, JobStatus::stalled);
  EXPECT_EQ(run(*runner, "get").status, JobStatus::ok);
}

TEST(JobLifetime, SeveralRunnersDoNotHoldEachOther)
{
  auto first = make_runner();
  const auto second = make_runner();
  const Family family = family_of(*first);
  first.reset();
  EXPECT_TRUE(has_ended(family.zygote));
  EXPECT_EQ(run(*second, "get").status, JobStatus::ok);
}

}  // namespace
}  // namespace tessera::jobs
