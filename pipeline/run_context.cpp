// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/run_context.hpp"

#include <csignal>
#include <utility>

#include "tessera/base/error.hpp"

#include "pipeline/stop_signal.hpp"

namespace tessera::pipeline {
namespace {

constexpr const char* kStopped = "stopped by a signal";

}  // namespace

StageScope::StageScope(RunContext& context, std::string name, std::int64_t total,
                       const std::string& unit)
    : context_(context), name_(std::move(name)), start_(std::chrono::steady_clock::now())
{
  context_.progress.begin(name_, total, unit);
}

double StageScope::elapsed_s() const
{
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

void StageScope::finish(const std::string& summary)
{
  const double own_s = work_s_ < 0.0 ? elapsed_s() : work_s_;
  const double min_s = context_.comm.min(own_s);
  const double max_s = context_.comm.max(own_s);
  context_.times.push_back({name_, elapsed_s(), min_s, max_s});
  context_.progress.end(summary);
  throw_if_stopped(context_.comm);
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
  jobs::JobOutcome outcome = context.jobs.run(job.request, job.limits, on_wait);
  if (!was_killed_from_outside(outcome) || outcome.loads_are_lost) return outcome;
  context.progress.clear();
  context.log.warn("{}: done again: {}", job.name, outcome.message);
  return context.jobs.run(job.request, job.limits, on_wait);
}

void throw_if_cancelled(const jobs::JobOutcome& outcome)
{
  if (outcome.status == jobs::JobStatus::cancelled) throw Interrupted(kStopped);
}

void throw_if_stopped(const comm::Communicator& comm)
{
  std::optional<std::string> stopped;
  if (stop_requested()) stopped = kStopped;
  comm.throw_if_any<Interrupted>(stopped);
}

}  // namespace tessera::pipeline
