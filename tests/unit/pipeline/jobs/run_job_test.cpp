// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/jobs/run_job.hpp"

#include <csignal>
#include <string>

#include <gtest/gtest.h>

#include "pipeline/stages/model/model_stage.hpp"
#include "support/temporary_folder.hpp"

namespace tessera::pipeline {
namespace {

using jobs::JobEnd;
using jobs::JobStatus;
using testing::message_of;

const JobEnd kStop{.status = JobStatus::cancelled, .message = "cancelled"};
const JobEnd kKill{.status = JobStatus::crashed, .code = SIGKILL, .message = "killed"};
const JobEnd kCrash{.status = JobStatus::crashed, .code = SIGSEGV, .message = "signal 11"};
const JobEnd kLoss{.status = JobStatus::crashed,
                   .code = SIGSEGV,
                   .loads_are_lost = true,
                   .message = "signal 11; what had been loaded is lost"};
const JobEnd kFullDisk{
    .status = JobStatus::failed, .error = ErrorKind::output, .message = "disk full"};
const JobEnd kOpenShell{
    .status = JobStatus::failed, .error = ErrorKind::geometry, .message = "open shell"};

TEST(RequireOk, ThrowsWhatTheEndSays)
{
  const auto require = [](const JobEnd& end) { return [&] { require_ok(end, "coarse"); }; };
  EXPECT_NO_THROW(require_ok({}, "coarse"));
  EXPECT_EQ(message_of<Interrupted>(require(kStop)), "stopped by a signal");
  EXPECT_EQ(message_of<NetgenError>(require(kCrash)), "coarse: signal 11");
  EXPECT_EQ(message_of<NetgenError>(require(kKill)), "coarse: killed; go on with --resume");
  EXPECT_EQ(message_of<OutputError>(require(kFullDisk)), "coarse: disk full");
  EXPECT_EQ(message_of<GeometryError>(require(kOpenShell)), "coarse: open shell");
}

TEST(ThrowUnlessOfTheJob, LeavesToTheStageWhatAnotherTryMayMend)
{
  const auto look = [](const JobEnd& end) { return [&] { throw_unless_of_the_job(end); }; };
  for (const JobEnd& end : {JobEnd{}, kCrash, kKill, kOpenShell}) EXPECT_NO_THROW(look(end)());
  EXPECT_EQ(message_of<Interrupted>(look(kStop)), "stopped by a signal");
  EXPECT_EQ(message_of<OutputError>(look(kFullDisk)), "disk full");
  EXPECT_EQ(message_of<MeshError>(look(kLoss)), kLoss.message + "; go on with --resume");
}

TEST(RequireRead, BlamesTheFileAndNotTheProgram)
{
  const auto require = [](const JobEnd& end) { return [&] { require_read(end, "a.step"); }; };
  const std::string blame = "a.step: the CAD library cannot read this model: ";
  const std::string way_out = "; repair it in a CAD program or export it anew";
  EXPECT_NO_THROW(require_read({}, "a.step"));
  EXPECT_EQ(message_of<GeometryError>(require(kCrash)), blame + "signal 11" + way_out);
  EXPECT_EQ(message_of<GeometryError>(require(kLoss)), blame + kLoss.message + way_out);
  EXPECT_EQ(message_of<GeometryError>(require(kOpenShell)), "a.step: open shell");
  EXPECT_EQ(message_of<MeshError>(require(kKill)), "a.step: killed; go on with --resume");
  EXPECT_EQ(message_of<Interrupted>(require(kStop)), "stopped by a signal");
}

TEST(ReadResult, MakesAFailureOfBytesThatCannotBeRead)
{
  jobs::JobOutcome outcome;
  outcome.result = to_bytes(std::string("box"));
  outcome.cpu_s = 2.0;
  const auto whole = read_result(outcome, from_bytes<std::string>);
  EXPECT_EQ(whole.made, "box");
  EXPECT_EQ(whole.cpu_s, 2.0);
  outcome.result.pop_back();
  const auto cut = read_result(outcome, from_bytes<std::string>);
  EXPECT_FALSE(cut.made);
  EXPECT_EQ(cut.end.status, JobStatus::failed);
  EXPECT_EQ(cut.end.error, ErrorKind::netgen);
}

}  // namespace
}  // namespace tessera::pipeline
