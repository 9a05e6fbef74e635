// SPDX-License-Identifier: BSD-3-Clause
#include "jobs/watch.hpp"

#include <algorithm>

namespace tessera::jobs {
namespace {

// A longer gap means that the watcher itself was stopped (Ctrl-Z) or busy. The process may have
// been, too, so the rest of the gap proves nothing.
constexpr double kLongestGap_s = 1.0;

}  // namespace

std::optional<JobStatus> Watch::look(const std::optional<ProcessSample>& sample,
                                     double since_last_look_s)
{
  const double cpu_s = sample ? std::max(0.0, sample->cpu_s - cpu_before_s_) : cpu_s_;
  const bool awake = cpu_s > cpu_s_ || (sample && sample->runnable);
  asleep_s_ = awake ? 0.0 : asleep_s_ + std::min(since_last_look_s, kLongestGap_s);
  cpu_s_ = cpu_s;
  if (sample) peak_rss_bytes_ = std::max(peak_rss_bytes_, sample->rss_bytes);

  constexpr double kGiB = 1024.0 * 1024.0 * 1024.0;
  if (static_cast<double>(peak_rss_bytes_) > limits_.memory_gib * kGiB)
    return JobStatus::out_of_memory;
  if (cpu_s_ > limits_.cpu_s) return JobStatus::out_of_time;
  if (asleep_s_ > limits_.stall_s) return JobStatus::stalled;
  return std::nullopt;
}

}  // namespace tessera::jobs
