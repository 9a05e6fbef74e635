// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "tessera/tessera.hpp"

#include "pipeline/predict/prediction_file.hpp"
#include "pipeline/run_result.hpp"
#include "pipeline/runtime/exit_code.hpp"
#include "pipeline/runtime/run_context.hpp"

namespace tessera::pipeline {

/// @brief How a finished run is judged: ok, or degraded with every reason.
struct Verdict {
  ExitCode exit_code = ExitCode::ok;
  std::vector<std::string> reasons{};
};

/// @brief Holds a finished run against the targets of its case.
[[nodiscard]] Verdict judge(const RunResult& run);

/// @brief Figures of the whole run that no stage knows.
struct RunFigures {
  std::string case_name{};
  int num_ranks = 1;
  bool is_resumed = false;
  double wall_time_s = 0.0;
  std::size_t peak_rss_bytes_max = 0;        ///< Of a rank with its job processes.
  std::vector<PredictedFigure> predicted{};  ///< Empty if there was no dry run of this run.
};

/// @brief What to say if parts of the output differ much in size. Local.
[[nodiscard]] std::optional<std::string> unbalanced_parts(const RunResult& run);

/// @brief What the caller of a finished run is told. Local.
[[nodiscard]] MeshResult result_of(const RunResult& run, const Verdict& verdict);

/// @brief report.json of a finished run.
[[nodiscard]] std::string report_json(const RunResult& run, const Verdict& verdict,
                                      const RunFigures& figures,
                                      const std::vector<StageTime>& times);

/// @brief report.json of a run that ended with an error.
[[nodiscard]] std::string failure_json(ExitCode exit_code, const std::string& reason,
                                       const RunFigures& figures,
                                       const std::vector<StageTime>& times);

}  // namespace tessera::pipeline
