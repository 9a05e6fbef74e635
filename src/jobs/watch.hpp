// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>

#include "tessera/jobs/job_runner.hpp"

#include "jobs/process_usage.hpp"

namespace tessera::jobs {

/// @brief Compares what a process uses with its limits, look by look.
class Watch {
 public:
  /// @param cpu_before_s CPU time that the process had used before the load or job began.
  Watch(const JobLimits& limits, double cpu_before_s) : limits_(limits), cpu_before_s_(cpu_before_s)
  {
  }

  /// @param sample Nothing if the process could not be looked at: that counts as sleep.
  /// @param since_last_look_s Wall time, seconds.
  /// @return The limit that is broken: out_of_time, stalled or out_of_memory.
  [[nodiscard]] std::optional<JobStatus> look(const std::optional<ProcessSample>& sample,
                                              double since_last_look_s);

  /// @brief The process says that it got on.
  void note_progress();

  /// @brief Whether it uses CPU time and does not get on, by JobLimits::idle_cpu_s.
  [[nodiscard]] bool is_idle() const noexcept;

  [[nodiscard]] double cpu_s() const noexcept { return cpu_s_; }  ///< At the last look.

  /// @brief CPU time since it last said that it got on, seconds.
  [[nodiscard]] double cpu_without_s() const noexcept { return cpu_s_ - cpu_at_progress_s_; }
  [[nodiscard]] std::size_t peak_rss_bytes() const noexcept { return peak_rss_bytes_; }

 private:
  JobLimits limits_;
  double cpu_before_s_;
  double cpu_s_ = 0.0;
  double asleep_s_ = 0.0;
  double cpu_at_progress_s_ = 0.0;
  double longest_without_s_ = 0.0;
  std::size_t peak_rss_bytes_ = 0;
};

}  // namespace tessera::jobs
