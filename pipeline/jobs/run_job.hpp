// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <utility>

#include "tessera/base/bytes.hpp"
#include "tessera/base/error.hpp"
#include "tessera/base/shared_bytes.hpp"
#include "tessera/jobs/job_runner.hpp"

#include "pipeline/runtime/run_context.hpp"

/// How ranks have jobs done, and what they make of one that failed: an error, or words in a record.
namespace tessera::pipeline {

/// @brief What to run under which name in the log.
struct JobRequest {
  std::string name{};
  const Bytes& request;
  const jobs::JobLimits& limits;
};

/// @brief Runs a job, and once more if it was killed from outside. So the mesh is the same as
/// without the kill. Local.
[[nodiscard]] jobs::JobOutcome run_job(const JobRequest& job,
                                       const jobs::JobRunner::WaitCallback& on_wait,
                                       RunContext& context);

/// @brief What a job has made, or how it failed.
template <class T>
struct JobResult {
  std::optional<T> made{};  ///< There if and only if `end` is ok.
  jobs::JobEnd end{};
  double cpu_s = 0.0;
};

/// @brief What `read` makes of the result of a job, if that has ended well. A result that cannot be
/// read becomes a failure of the job: third-party code may have damaged its memory. Local.
template <class Read>
auto read_result(const jobs::JobOutcome& outcome, const Read& read)
    -> JobResult<decltype(read(outcome.result))>
{
  JobResult<decltype(read(outcome.result))> result{{}, outcome, outcome.cpu_s};
  if (outcome.status != jobs::JobStatus::ok) return result;
  try {
    result.made = read(outcome.result);
  } catch (const InputError& error) {
    result.end = {.status = jobs::JobStatus::failed,
                  .error = ErrorKind::netgen,
                  .message = std::string("gave a result that cannot be used: ") + error.what()};
  }
  return result;
}

/// @brief Throws Interrupted if the callback cancelled the job. Local.
void throw_if_cancelled(const jobs::JobEnd& end);

/// @brief Runs a job as run_job() and reads its result as read_result(). Local.
/// @throws Interrupted if the job was cancelled.
template <class Read>
[[nodiscard]] auto attempt_job(const JobRequest& job, const Read& read,
                               const jobs::JobRunner::WaitCallback& on_wait, RunContext& context)
{
  auto result = read_result(run_job(job, on_wait, context), read);
  throw_if_cancelled(result.end);
  return result;
}

/// @brief Loads a message of some kind, in place of an earlier one of that kind. Local.
/// @param[in] told  What the worker is told in its place, if that is not the message itself.
[[nodiscard]] jobs::JobOutcome run_load(const std::string& kind, SharedBytes message,
                                        const jobs::JobLimits& limits, RunContext& context,
                                        const Bytes& told = {});

/// @brief Whether somebody else ended the job, by hand or for lack of memory. Such an end says
/// nothing about what the job was to do. Local.
[[nodiscard]] bool was_killed_from_outside(const jobs::JobEnd& end);

/// @brief Whether the same job might have ended otherwise on another machine. Local.
[[nodiscard]] bool depends_on_machine(const jobs::JobEnd& end);

/// @brief What to add to a job's message where the same run could go well next time. That is so if
/// nothing was wrong with the job, or what had been loaded for it is lost. Local.
[[nodiscard]] std::string way_on(const jobs::JobEnd& end);

/// @brief Throws for what ends a run that cannot go on without this job or load; way_on() is part
/// of the text. Stages whose last try has failed throw what all of them said; else this is where
/// the end of a job becomes an error. Local.
/// @param[in] what What it is about; empty: the message says so.
/// @throws Interrupted if it was cancelled, else as jobs::throw_unless_ok().
void require_ok(const jobs::JobEnd& end, const std::string& what);

/// @brief What a job has made. Local. @throws what require_ok() throws.
template <class T>
[[nodiscard]] T require_made(JobResult<T> result, const std::string& what)
{
  require_ok(result.end, what);
  return *std::move(result.made);
}

/// @brief Throws for what another try cannot mend: a stop, a full disk, a lost worker. Local.
/// @throws what require_ok() throws.
void throw_unless_of_the_job(const jobs::JobEnd& end);

}  // namespace tessera::pipeline
