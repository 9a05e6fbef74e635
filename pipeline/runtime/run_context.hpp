// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "tessera/base/shared_bytes.hpp"
#include "tessera/comm/communicator.hpp"
#include "tessera/jobs/job_runner.hpp"

#include "pipeline/runtime/progress.hpp"
#include "pipeline/runtime/stage.hpp"

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
  StageScope(RunContext& context, Stage stage, std::int64_t total = 0,
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

/// @brief Throws Interrupted on all ranks if a stop signal came to any. @note Collective.
void throw_if_stopped(const comm::Communicator& comm);

}  // namespace tessera::pipeline
