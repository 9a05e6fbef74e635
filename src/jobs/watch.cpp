// SPDX-License-Identifier: BSD-3-Clause
#include "jobs/watch.hpp"

#include <algorithm>

namespace tessera::jobs {
namespace {

// A longer gap means that the watcher itself was stopped (Ctrl-Z) or busy. The process may have
// been, too, so the rest of the gap proves nothing.
constexpr double kLongestGap_s = 1.0;

// Steps of one job differ in length: so many times the longest one so far is still none too long.
constexpr double kPatience = 10.0;

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
  if (asleep_s_ > limits_.stall_s || is_idle()) return JobStatus::stalled;
  return std::nullopt;
}

void Watch::note_progress()
{
  longest_without_s_ = std::max(longest_without_s_, cpu_without_s());
  cpu_at_progress_s_ = cpu_s_;
}

bool Watch::is_idle() const noexcept
{
  const double most_s = std::max(limits_.idle_cpu_s, kPatience * longest_without_s_);
  return limits_.idle_cpu_s > 0.0 && cpu_without_s() > most_s;
}

}  // namespace tessera::jobs
