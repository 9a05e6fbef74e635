// SPDX-License-Identifier: BSD-3-Clause
// How loads and jobs end, with real failures in the worker processes.
#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <unistd.h>

#include "tessera/base/error.hpp"
#include "tessera/jobs/job_runner.hpp"
#include "tessera/jobs/this_process.hpp"

#include "support/failing_worker.hpp"

namespace tessera::jobs {
namespace {

using ::tessera::testing::bytes_of;
using ::tessera::testing::FailingWorker;
using ::tessera::testing::text_of;

class JobOutcomes : public ::testing::Test {
 protected:
  JobOutcome load(const std::string& command) { return runner_.load(bytes_of(command), {}, {}); }
  JobOutcome run(const std::string& command) { return runner_.run(bytes_of(command), {}, {}); }

  void expect_usable()
  {
    ASSERT_EQ(load("append ok").status, JobStatus::ok);
    const JobOutcome outcome = run("get");
    ASSERT_EQ(outcome.status, JobStatus::ok) << outcome.message;
    EXPECT_TRUE(text_of(outcome.result).ends_with("ok"));
  }

  JobRunner runner_{[] { return std::make_unique<FailingWorker>(); }};
};

TEST_F(JobOutcomes, LoadedStateIsSeenByAllLaterRuns)
{
  EXPECT_EQ(text_of(run("get").result), "");
  EXPECT_EQ(load("append a").status, JobStatus::ok);
  EXPECT_EQ(load("append b").status, JobStatus::ok);
  for (int i = 0; i < 3; ++i) EXPECT_EQ(text_of(run("get").result), "ab");
}

TEST_F(JobOutcomes, ChangesOfARunAreLost)
{
  EXPECT_EQ(run("append a").status, JobStatus::ok);
  EXPECT_EQ(text_of(run("get").result), "");
}

TEST_F(JobOutcomes, AJobThatIsAloneHasAThreadForEachRankOfItsNode)
{
  const JobLimits alone{.is_alone = true};
  const auto num_threads_of_job = [&](const JobLimits& limits) {
    return text_of(runner_.run(bytes_of("threads"), limits, {}).result);
  };
  EXPECT_EQ(num_threads_of_job(alone), "1") << "no ranks are known";
  const std::vector<int> cores = cores_of_this_thread();
  runner_.set_node(2, cores);
  EXPECT_EQ(num_threads_of_job({}), "1");
  EXPECT_EQ(num_threads_of_job(alone), cores.size() > 1 ? "2" : "1");
  runner_.set_node(2, {cores.front()});
  EXPECT_EQ(num_threads_of_job(alone), "1") << "both ranks have one core";
}

TEST_F(JobOutcomes, ExceptionsArriveWithKindAndText)
{
  struct Case {
    std::string kind;
    ErrorKind error;
    std::string message;
  };
  for (const Case& c :
       {Case{"config", ErrorKind::config, "no config"}, Case{"input", ErrorKind::input, "no input"},
        Case{"geometry", ErrorKind::geometry, "no geometry"},
        Case{"mesh", ErrorKind::mesh, "no mesh"}, Case{"netgen", ErrorKind::netgen, "no netgen"},
        Case{"output", ErrorKind::output, "no output"}, Case{"other", ErrorKind::other, "no logic"},
        Case{"int", ErrorKind::other, "an exception of unknown type"}}) {
    for (const JobOutcome& outcome : {load("throw " + c.kind), run("throw " + c.kind)}) {
      EXPECT_EQ(outcome.status, JobStatus::failed) << c.kind;
      EXPECT_EQ(outcome.error, c.error) << c.kind;
      EXPECT_EQ(outcome.message, c.message);
      EXPECT_TRUE(outcome.result.empty());
    }
  }
  expect_usable();
}

TEST_F(JobOutcomes, FailedAllocationIsOutOfMemory)
{
  EXPECT_EQ(run("throw alloc").status, JobStatus::out_of_memory);
  EXPECT_EQ(load("throw alloc").status, JobStatus::out_of_memory);
}

TEST_F(JobOutcomes, FailedLoadKeepsWhatWasLoadedBefore)
{
  EXPECT_EQ(load("append a").status, JobStatus::ok);
  EXPECT_EQ(load("throw mesh").status, JobStatus::failed);
  EXPECT_EQ(text_of(run("get").result), "a");
}

TEST_F(JobOutcomes, CrashesAndExitsOfAJobNameSignalAndCode)
{
  EXPECT_EQ(load("append a").status, JobStatus::ok);
  const JobOutcome crash = run("segfault");
  EXPECT_EQ(crash.status, JobStatus::crashed);
  EXPECT_EQ(crash.code, SIGSEGV);
  EXPECT_EQ(crash.message, "ended by signal 11 (Segmentation fault)");
  const JobOutcome abort = run("abort");
  EXPECT_EQ(abort.status, JobStatus::crashed);
  EXPECT_EQ(abort.code, SIGABRT);
  for (const int code : {0, 3}) {
    const JobOutcome exit = run("exit " + std::to_string(code));
    EXPECT_EQ(exit.status, JobStatus::exited);
    EXPECT_EQ(exit.code, code);
  }
  EXPECT_EQ(text_of(run("get").result), "a");
}

TEST_F(JobOutcomes, CrashOfALoadLosesTheStateAndAFreshLoadWorks)
{
  for (const std::string command : {"segfault", "abort", "exit 3"}) {
    EXPECT_EQ(load("append a").status, JobStatus::ok);
    const JobOutcome outcome = load(command);
    EXPECT_EQ(outcome.status, command == "exit 3" ? JobStatus::exited : JobStatus::crashed);
    EXPECT_NE(outcome.message.find("what had been loaded is lost"), std::string::npos);
    EXPECT_EQ(text_of(run("get").result), "") << command;
  }
  expect_usable();
}

TEST_F(JobOutcomes, LargeRequestsAndResultsArriveWhole)
{
  const JobOutcome outcome = run("zeros 64");
  ASSERT_EQ(outcome.status, JobStatus::ok);
  EXPECT_EQ(outcome.result, Bytes(std::size_t{64} << 20));

  const std::string text(std::size_t{20} << 20, 'x');
  ASSERT_EQ(load("append " + text).status, JobStatus::ok);
  EXPECT_EQ(text_of(run("get").result), text);
}

TEST_F(JobOutcomes, OutputOfWorkersGoesToTheLogFile)
{
  const auto log =
      std::filesystem::temp_directory_path() / ("tessera_job_log_" + std::to_string(::getpid()));
  EXPECT_EQ(run("write nowhere").status, JobStatus::ok);
  runner_.set_log_file(log);
  EXPECT_EQ(load("write load").status, JobStatus::ok);
  EXPECT_EQ(run("write run").status, JobStatus::ok);
  std::ifstream file(log);
  std::string text(std::istreambuf_iterator<char>(file), {});
  std::filesystem::remove(log);
  for (const std::string part : {"stdout load", "stderr load\n", "stdout run", "stderr run\n"})
    EXPECT_NE(text.find(part), std::string::npos) << text;
  EXPECT_EQ(text.find("nowhere"), std::string::npos);
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 2);
}

TEST_F(JobOutcomes, WorkerThatCannotBeMadeFailsEveryCall)
{
  JobRunner runner([]() -> std::unique_ptr<Worker> { throw InputError("no worker"); });
  for (const JobOutcome& outcome : {runner.load({}, {}, {}), runner.run({}, {}, {})}) {
    EXPECT_EQ(outcome.status, JobStatus::failed);
    EXPECT_EQ(outcome.error, ErrorKind::input);
    EXPECT_EQ(outcome.message, "no worker");
  }
}

TEST_F(JobOutcomes, HundredJobsLeaveNoDescriptorsBehind)
{
  const std::string before = text_of(run("descriptors").result);
  for (int i = 0; i < 100; ++i) ASSERT_EQ(run("get").status, JobStatus::ok);
  EXPECT_EQ(text_of(run("descriptors").result), before);
  EXPECT_EQ(before, "1");  // the way to the rank
}

TEST_F(JobOutcomes, UsageIsWhatJobsUsedSinceItWasRestarted)
{
  JobOutcome large = run("zeros 64");
  const JobUsage first = runner_.usage();
  EXPECT_DOUBLE_EQ(first.cpu_s, large.cpu_s);
  constexpr std::size_t kLarge = std::size_t{64} << 20;
  EXPECT_GT(first.peak_rss_bytes, kLarge);
  EXPECT_EQ(first.peak_rss_bytes, runner_.peak_rss_bytes());

  runner_.restart_usage();
  const double cpu_s = run("get").cpu_s + load("append a").cpu_s;
  EXPECT_DOUBLE_EQ(runner_.usage().cpu_s, cpu_s);
  EXPECT_LT(runner_.usage().peak_rss_bytes + kLarge / 2, first.peak_rss_bytes);
  EXPECT_GT(runner_.usage().loaded_bytes, 0U);
  EXPECT_LE(runner_.usage().loaded_bytes, runner_.usage().peak_rss_bytes);
  EXPECT_EQ(runner_.peak_rss_bytes(), first.peak_rss_bytes);
}

TEST(ThrowUnlessOk, ThrowsTheErrorThatTheOutcomeNames)
{
  const auto outcome = [](JobStatus status, std::optional<ErrorKind> error = std::nullopt) {
    JobOutcome made;
    made.status = status;
    made.error = error;
    made.message = "text";
    return made;
  };
  EXPECT_NO_THROW(throw_unless_ok(outcome(JobStatus::ok), "job"));
  EXPECT_THROW(throw_unless_ok(outcome(JobStatus::failed, ErrorKind::config), "job"), ConfigError);
  EXPECT_THROW(throw_unless_ok(outcome(JobStatus::failed, ErrorKind::geometry), "job"),
               GeometryError);
  EXPECT_THROW(throw_unless_ok(outcome(JobStatus::failed, ErrorKind::output), "job"), OutputError);
  EXPECT_THROW(throw_unless_ok(outcome(JobStatus::failed, ErrorKind::other), "job"), Error);
  EXPECT_THROW(throw_unless_ok(outcome(JobStatus::failed), "job"), Error);
  EXPECT_THROW(throw_unless_ok(outcome(JobStatus::cancelled), "job"), Interrupted);
  for (const JobStatus status : {JobStatus::crashed, JobStatus::exited, JobStatus::out_of_time,
                                 JobStatus::stalled, JobStatus::out_of_memory})
    EXPECT_THROW(throw_unless_ok(outcome(status), "job"), NetgenError);
  try {
    throw_unless_ok(outcome(JobStatus::crashed), "job 7");
  } catch (const NetgenError& error) {
    EXPECT_STREQ(error.what(), "job 7: text");
  }
}

}  // namespace
}  // namespace tessera::jobs
