// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/runtime/run_context.hpp"

#include <cmath>
#include <utility>

#include "tessera/comm/all_or_none.hpp"
#include "tessera/jobs/this_process.hpp"

#include "pipeline/runtime/stop_signal.hpp"

namespace tessera::pipeline {

StageScope::StageScope(RunContext& context, Stage stage, std::int64_t total,
                       const std::string& unit)
    : context_(context),
      name_(word_of(stage)),
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

void throw_if_stopped(const comm::Communicator& comm)
{
  all_or_none(comm, throw_if_stop_requested);
}

}  // namespace tessera::pipeline
