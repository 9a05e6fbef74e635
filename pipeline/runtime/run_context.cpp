// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/runtime/run_context.hpp"

#include <cmath>
#include <csignal>
#include <system_error>
#include <utility>

#include "tessera/base/error.hpp"
#include "tessera/comm/all_or_none.hpp"
#include "tessera/jobs/this_process.hpp"

#include "pipeline/runtime/stop_signal.hpp"

namespace tessera::pipeline {

StageScope::StageScope(RunContext& context, std::string name, std::int64_t total,
                       const std::string& unit)
    : context_(context),
      name_(std::move(name)),
      start_(std::chrono::steady_clock::now()),
      cpu_before_s_(jobs::cpu_time_of_this_process())
{
  context_.jobs.restart_usage();
  context_.progress.begin(name_, total, unit);
}

double StageScope::elapsed_s() const
{
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

double StageScope::used_cpu_s() const
{
  return jobs::cpu_time_of_this_process() - cpu_before_s_ + context_.jobs.usage().cpu_s;
}

void StageScope::work_is_done()
{
  work_s_ = elapsed_s();
  work_cpu_s_ = used_cpu_s();
}

void StageScope::finish(const std::string& summary)
{
  if (work_s_ < 0.0) work_is_done();
  const comm::Communicator& comm = context_.comm;
  constexpr double kTicks = 1e6;  // A sum of integers is the same in any order.
  const GlobalIndex cpu_ticks = comm.sum(std::llround(kTicks * work_cpu_s_));
  StageTime time{
      .name = name_,
      .rank_min_s = comm.min(work_s_),
      .rank_max_s = comm.max(work_s_),
      .cpu_s = static_cast<double>(cpu_ticks) / kTicks,
      .rank_max_cpu_s = comm.max(work_cpu_s_),
      .jobs_peak_rss_bytes = comm.max(static_cast<double>(context_.jobs.usage().peak_rss_bytes))};
  time.wall_s = elapsed_s();
  context_.times.push_back(std::move(time));
  context_.progress.end(summary);
  throw_if_stopped(comm);
}

jobs::JobRunner::WaitCallback wait_for_stop_signal()
{
  return [] { return !stop_requested(); };
}

bool was_killed_from_outside(const jobs::JobOutcome& outcome)
{
  return outcome.status == jobs::JobStatus::crashed && outcome.code == SIGKILL;
}

jobs::JobOutcome run_job(const JobRequest& job, const jobs::JobRunner::WaitCallback& on_wait,
                         RunContext& context)
{
  std::error_code error;  // Without a log the job has said nothing.
  const std::uintmax_t log_size = std::filesystem::file_size(context.jobs_log, error);
  context.job_log_begin = error ? 0 : log_size;
  jobs::JobOutcome outcome = context.jobs.run(job.request, job.limits, on_wait);
  if (!was_killed_from_outside(outcome) || outcome.loads_are_lost) return outcome;
  context.progress.clear();
  context.log.warn("{}: done again: {}", job.name, outcome.message);
  return context.jobs.run(job.request, job.limits, on_wait);
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

std::string way_on(const jobs::JobOutcome& outcome)
{
  return was_killed_from_outside(outcome) || outcome.loads_are_lost ? "; go on with --resume" : "";
}

void throw_if_cancelled(const jobs::JobOutcome& outcome)
{
  if (outcome.status == jobs::JobStatus::cancelled) throw Interrupted(kStopped);
}

void throw_if_stopped(const comm::Communicator& comm)
{
  all_or_none(comm, throw_if_stop_requested);
}

}  // namespace tessera::pipeline
