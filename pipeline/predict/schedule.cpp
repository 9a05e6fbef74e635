// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/predict/schedule.hpp"

#include <algorithm>
#include <functional>
#include <queue>

#include "tessera/base/types.hpp"

namespace tessera::pipeline {

Schedule simulate_schedule(const std::vector<double>& job_s, int workers)
{
  Schedule schedule;
  // When each worker is free again; those beyond the number of jobs never get one.
  const std::size_t num_used = std::min(job_s.size(), at(workers));
  std::priority_queue<double, std::vector<double>, std::greater<>> free_at(
      std::greater<>{}, std::vector<double>(num_used, 0.0));
  for (const double duration : job_s) {
    const double end = free_at.top() + duration;
    free_at.pop();
    free_at.push(end);
    schedule.work_s += duration;
    schedule.makespan_s = std::max(schedule.makespan_s, end);
  }
  if (schedule.makespan_s > 0.0) {
    schedule.busy_share = schedule.work_s / (static_cast<double>(workers) * schedule.makespan_s);
  }
  return schedule;
}

}  // namespace tessera::pipeline
