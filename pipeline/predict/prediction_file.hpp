// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tessera/config/case.hpp"

#include "pipeline/predict/calibrate.hpp"
#include "pipeline/predict/prediction.hpp"
#include "pipeline/run_result.hpp"

/// What a dry run says: `DIR/prediction.json`, a table for people, and later the block "prediction"
/// of report.json.
///
/// prediction.json (schema 1) has:
/// - "schema", "version"; "case" and "model", hashes that tell whether a run is the one that was
///   predicted; "ranks", "levels", "coarse_tets", "subdomains";
/// - counts: "tets", "vertices", "boundary_triangles", "files" (in mesh/ and boundary/);
/// - bytes: "disk_bytes" (of those files), "disk_peak_bytes" (with the pieces that wait for their
///   ids), "memory_per_rank_bytes" (with its worker processes), "memory_of_node_bytes" (of that,
///   what all ranks of a node share), "largest_job_bytes";
/// - times: "cpu_s" (plan, fill and write, all ranks), "wall_time_s", "serial_share", "busy_share";
/// - "plan": names of the stages that the run will have, in their order, as in its report;
/// - "stages": "name", "wall_time_s", "cpu_s", "serial"; of those that take a while;
/// - "resources": "disk_free_bytes", "memory_bytes", "cores";
/// - "samples": "kernel", "levels", "subdomains", "cpu_s"; "rates" by kernel; "fits";
/// - "must_change" and "should_change": sentences.
///
/// Times are those of free cores.
namespace tessera::pipeline {

/// @brief What a dry run has foretold, and what it became.
struct PredictedFigure {
  std::string name{};
  double predicted = 0.0;
  double actual = 0.0;
};

/// @brief Whose prediction it is: a run of another case, model or version, or of other subdomains,
/// is not that run.
struct PredictedRun {
  std::string case_hash{};
  std::string model_hash{};

  PredictedRun(const config::Case& given, const RunResult& run);
};

/// @brief All that a dry run has found.
struct DryRun {
  StageList stages{};  ///< Of the run, as it plans them.
  Prediction prediction{};
  Calibration calibration{};
  Resources resources{};
  Advice advice{};
};

[[nodiscard]] std::string prediction_json(const DryRun& dry_run, const PredictedRun& predicted);

/// @brief The same for people, several lines.
[[nodiscard]] std::string prediction_table(const DryRun& dry_run);

/// @brief What a run turned out to be, of the quantities that prediction.json has.
struct ActualRun {
  int num_ranks = 1;
  bool is_resumed = false;  ///< Its times are not those of the whole work.
  double tets = 0.0;
  double vertices = 0.0;
  double boundary_triangles = 0.0;
  double files = 0.0;
  double disk_bytes = 0.0;
  double memory_per_rank_bytes = 0.0;
  double wall_time_s = 0.0;
  std::vector<StageTime> stages{};
};

/// @brief Each predicted quantity with what became of it. Times of stages are compared as CPU time
/// ("fill_cpu_s"), and as wall time if the run has as many ranks as were predicted. Local.
/// @return Nothing if `folder` has no prediction of this very run.
[[nodiscard]] std::vector<PredictedFigure> compare_with_prediction(
    const std::filesystem::path& folder, const PredictedRun& run, const ActualRun& actual);

}  // namespace tessera::pipeline
