// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/jobs/run_job.hpp"

#include <csignal>
#include <cstdint>
#include <filesystem>
#include <span>
#include <system_error>
#include <utility>

#include "pipeline/runtime/stop_signal.hpp"

namespace tessera::pipeline {

jobs::JobOutcome run_job(const JobRequest& job, const jobs::JobRunner::WaitCallback& on_wait,
                         RunContext& context)
{
  std::error_code error;  // Without a log the job has said nothing.
  const std::uintmax_t log_size = std::filesystem::file_size(context.jobs_log, error);
  context.job_log_begin = error ? 0 : log_size;
  jobs::JobOutcome outcome = context.jobs.run(job.request, job.limits, on_wait);
  if (!was_killed_from_outside(outcome) || outcome.loads_are_lost) return outcome;
  context.progress.clear();
  context.log.warn(fmt::format("{}: done again: {}", job.name, outcome.message));
  return context.jobs.run(job.request, job.limits, on_wait);
}

void throw_if_cancelled(const jobs::JobEnd& end)
{
  if (end.status == jobs::JobStatus::cancelled) throw Interrupted(kStopped);
}

jobs::JobOutcome run_load(const std::string& kind, SharedBytes message,
                          const jobs::JobLimits& limits, RunContext& context, const Bytes& told)
{
  const std::span<const std::byte> sent = told.empty() ? message.bytes() : told;
  jobs::JobOutcome outcome = context.jobs.load(sent, limits, wait_for_stop_signal());
  if (outcome.status != jobs::JobStatus::ok) return outcome;
  for (auto& [known, loaded] : context.loads) {
    if (known != kind) continue;
    loaded = std::move(message);
    return outcome;
  }
  context.loads.emplace_back(kind, std::move(message));
  return outcome;
}

bool was_killed_from_outside(const jobs::JobEnd& end)
{
  return end.status == jobs::JobStatus::crashed && end.code == SIGKILL;
}

bool depends_on_machine(const jobs::JobEnd& end)
{
  return end.status == jobs::JobStatus::out_of_time || end.status == jobs::JobStatus::stalled
         || end.status == jobs::JobStatus::out_of_memory || was_killed_from_outside(end);
}

std::string way_on(const jobs::JobEnd& end)
{
  return was_killed_from_outside(end) || end.loads_are_lost ? "; go on with --resume" : "";
}

void require_ok(const jobs::JobEnd& end, const std::string& what)
{
  throw_if_cancelled(end);
  jobs::JobEnd told = end;
  told.message += way_on(end);
  jobs::throw_unless_ok(told, what);
}

void throw_unless_of_the_job(const jobs::JobEnd& end)
{
  const bool is_of_the_job = end.error != ErrorKind::output && end.error != ErrorKind::config
                             && !end.loads_are_lost && end.status != jobs::JobStatus::cancelled;
  if (!is_of_the_job) require_ok(end, "");
}

}  // namespace tessera::pipeline
