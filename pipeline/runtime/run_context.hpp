// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tessera/base/error.hpp"
#include "tessera/base/shared_bytes.hpp"
#include "tessera/comm/communicator.hpp"
#include "tessera/jobs/job_runner.hpp"

#include "pipeline/runtime/progress.hpp"

namespace tessera::pipeline {

/// @brief What one stage took. CPU time counts ranks with their jobs; on a machine that is busy
/// with other things it says more than wall time.
struct StageTime {
  std::string name{};
  double wall_s = 0.0;      ///< On rank 0, waiting included, seconds.
  double rank_min_s = 0.0;  ///< Smallest time that a rank was at work, seconds.
  double rank_max_s = 0.0;
  double cpu_s = 0.0;                ///< Of all ranks together, seconds.
  double rank_max_cpu_s = 0.0;       ///< Of the rank that used most, seconds.
  double jobs_peak_rss_bytes = 0.0;  ///< Largest of a rank's worker processes together.
};

/// @brief What every stage may use. Owned by the mesh command, borrowed by the stages.
struct RunContext {
  const comm::Communicator& comm;
  jobs::JobRunner& jobs;
  Progress& progress;
  spdlog::logger& log;               ///< Console and log/run.log; rank 0 speaks, others are silent.
  std::filesystem::path folder;      ///< The output folder.
  std::filesystem::path jobs_log{};  ///< What this rank's jobs print goes there.
  std::vector<StageTime> times{};
  /// What this rank's jobs start from, by kind, in the order of the loads: a failed job is kept
  /// with it.
  std::vector<std::pair<std::string, SharedBytes>> loads{};
  std::uintmax_t job_log_begin = 0;  ///< Where in jobs_log the last job's words begin.
  std::size_t num_failed_jobs_kept = 0;
};

/// @brief Times one stage and speaks of it: begins with the object, ends with finish().
class StageScope {
 public:
  StageScope(RunContext& context, std::string name, std::int64_t total = 0,
             const std::string& unit = "");

  /// @brief Marks the end of this rank's own work; what follows is waiting for others.
  void work_is_done();

  /// @brief Ends the stage. @note Collective.
  void finish(const std::string& summary);

 private:
  [[nodiscard]] double elapsed_s() const;
  [[nodiscard]] double used_cpu_s() const;

  RunContext& context_;
  std::string name_;
  std::chrono::steady_clock::time_point start_;
  double cpu_before_s_;
  double work_s_ = -1.0;
  double work_cpu_s_ = 0.0;
};

/// @brief Callback for jobs beside which this rank has nothing to do: cancels on a stop signal.
[[nodiscard]] jobs::JobRunner::WaitCallback wait_for_stop_signal();

/// @brief Whether somebody else ended the job, by hand or for lack of memory. Such an end says
/// nothing about what the job was to do. Local.
[[nodiscard]] bool was_killed_from_outside(const jobs::JobOutcome& outcome);

/// @brief What to run under which name in the log.
struct JobRequest {
  std::string name{};
  const Bytes& request;
  const jobs::JobLimits& limits;
};

/// @brief Runs a job, and once more if it was killed from outside. So the mesh is the same as
/// without the kill. Local.
[[nodiscard]] jobs::JobOutcome run_job(const JobRequest& job,
                                       const jobs::JobRunner::WaitCallback& on_wait,
                                       RunContext& context);

/// @brief What `read` makes of the result of a job, if that has ended well. A result that cannot be
/// read becomes a failure of the job: third-party code may have damaged its memory. Local.
template <class Read>
auto read_result(jobs::JobOutcome& outcome, const Read& read)
    -> std::optional<decltype(read(outcome.result))>
{
  if (outcome.status != jobs::JobStatus::ok) return std::nullopt;
  try {
    return read(outcome.result);
  } catch (const InputError& error) {
    outcome.status = jobs::JobStatus::failed;
    outcome.error = ErrorKind::netgen;
    outcome.message = std::string("gave a result that cannot be used: ") + error.what();
    return std::nullopt;
  }
}

/// @brief Loads a message of some kind, in place of an earlier one of that kind. Local.
/// @param[in] told  What the worker is told in its place, if that is not the message itself.
[[nodiscard]] jobs::JobOutcome run_load(const std::string& kind, SharedBytes message,
                                        const jobs::JobLimits& limits, RunContext& context,
                                        const Bytes& told = {});

/// @brief What to add to a job's message where the same run could go well next time. That is so if
/// nothing was wrong with the job, or what had been loaded for it is lost. Local.
[[nodiscard]] std::string way_on(const jobs::JobOutcome& outcome);

/// @brief Throws Interrupted if the outcome says that the callback cancelled the job. Local.
void throw_if_cancelled(const jobs::JobOutcome& outcome);

/// @brief Throws Interrupted on all ranks if a stop signal came to any. @note Collective.
void throw_if_stopped(const comm::Communicator& comm);

}  // namespace tessera::pipeline
