// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

namespace tessera::jobs {

/// @brief Largest resident memory of the calling process since it started, bytes. Local.
///
/// A rank with its jobs used at most this plus JobRunner::peak_rss_bytes().
[[nodiscard]] std::size_t peak_rss_of_this_process();

/// @brief CPU time of all threads of the calling process since it started, seconds. Local.
[[nodiscard]] double cpu_time_of_this_process();

/// @brief Numbers of the cores on which the calling thread may run, ascending; none if that cannot
/// be told. Local.
[[nodiscard]] std::vector<int> cores_of_this_thread();

/// @brief In a job: tells its rank that it got on, for JobLimits::idle_cpu_s. Cheap, so call it at
/// every sign of progress. Does nothing in another process. Local.
void report_progress();

}  // namespace tessera::jobs
