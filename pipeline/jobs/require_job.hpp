// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <utility>

#include "pipeline/jobs/failed_jobs.hpp"
#include "pipeline/jobs/for_each_dynamic.hpp"

namespace tessera::pipeline {

/// @brief Runs a job without which the run cannot go on. Local.
/// @param[in] decode Makes the result of bytes. @param[in] what For the error: what it is about.
/// @throws what jobs::throw_unless_ok() throws.
template <class Decode>
auto require_job(const JobRequest& job, const Decode& decode, const std::string& what,
                 RunContext& context)
{
  jobs::JobOutcome outcome = run_job(job, wait_for_stop_signal(), context);
  auto made = read_result(outcome, decode);
  keep_if_failed(job, outcome, context);
  throw_if_cancelled(outcome);
  outcome.message += way_on(outcome);
  jobs::throw_unless_ok(outcome, what);
  return *std::move(made);
}

}  // namespace tessera::pipeline
