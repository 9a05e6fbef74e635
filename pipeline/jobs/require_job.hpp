// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <utility>

#include "pipeline/jobs/failed_jobs.hpp"
#include "pipeline/jobs/run_job.hpp"

namespace tessera::pipeline {

/// @brief Runs a job without which the run cannot go on, and keeps it if it fails. Local.
/// @param[in] read Makes the result of bytes. @param[in] what For the error: what it is about.
/// @throws what require_ok() throws.
template <class Read>
auto require_job(const JobRequest& job, const Read& read, const std::string& what,
                 RunContext& context)
{
  auto result = attempt_job(job, read, wait_for_stop_signal(), context);
  keep_if_failed(job, result.end, context);
  return require_made(std::move(result), what);
}

}  // namespace tessera::pipeline
