// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "pipeline/estimate/rates.hpp"
#include "pipeline/estimate/run_outline.hpp"
#include "pipeline/runtime/run_context.hpp"

namespace tessera::pipeline {

/// @brief What one stage will take on free cores.
struct StagePrediction {
  std::string name{};
  double wall_s = 0.0;
  double cpu_s = 0.0;      ///< Of all ranks together.
  bool is_serial = false;  ///< More ranks do not make it shorter.
};

/// @brief What a run will make and need.
struct Prediction {
  int num_ranks = 1;
  int levels = 0;
  GlobalIndex num_coarse_tets = 0;
  GlobalIndex num_subdomains = 0;
  GlobalIndex num_tets = 0;
  GlobalIndex num_vertices = 0;
  GlobalIndex num_boundary_triangles = 0;  ///< Of what is written.
  GlobalIndex num_files = 0;               ///< In mesh/ and boundary/.
  double disk_bytes = 0.0;                 ///< Of those files.
  double disk_peak_bytes = 0.0;            ///< With the pieces that wait in the store.
  double memory_per_rank_bytes = 0.0;      ///< Largest of a rank with its worker processes.
  double memory_of_node_bytes = 0.0;       ///< Of that, what all ranks of a node share.
  double largest_job_bytes = 0.0;  ///< Resident memory of one fill job, with what it shares with
                                   ///< its zygotes; fill.memory_gib bounds it.
  std::vector<StagePrediction> stages{};
  double wall_s = 0.0;        ///< Of all stages.
  double serial_share = 0.0;  ///< Of the wall time, in [0, 1].
  double busy_share = 1.0;    ///< Of the ranks' time while they share work, in (0, 1].
};

/// @brief Memory of a rank before any fill, bytes; the largest over the ranks.
struct RankMemory {
  double process = 0.0;    ///< The rank itself, so far.
  double loaded = 0.0;     ///< Its zygotes with model and coarse mesh.
  double jobs_peak = 0.0;  ///< Its zygotes and jobs together, so far.
  double shared = 0.0;     ///< Of the rank itself, what stands once a node.
};

/// @brief What a prediction starts from.
struct PredictionBasis {
  RunOutline outline{};  ///< With the numbers that are to be believed.
  Rates rates{};
  RankMemory memory{};
  std::vector<StageTime> serial_stages{};  ///< Those that are done already.
  int num_ranks = 1;
};

/// @brief Adds up the outline with the rates, and lets the jobs run on so many ranks in thought.
/// Local; a tenth of a second for 10^5 subdomains and ranks.
///
/// Left out, being small on all that was measured: messages between ranks, the verify stage,
/// further rounds of plan where surfaces fold.
[[nodiscard]] Prediction predict(const PredictionBasis& basis);

/// @brief What there is to hold a prediction against.
struct Resources {
  double free_disk_bytes = 0.0;
  double machine_memory_bytes = 0.0;
  int num_cores = 1;            ///< Of this machine: it will not be given more ranks.
  double job_memory_gib = 0.0;  ///< fill.memory_gib.
};

/// @brief What of this machine the run may use. Local. @throws OutputError if the folder's file
/// system cannot be asked.
[[nodiscard]] Resources resources_of_this_machine(const std::filesystem::path& folder,
                                                  double job_memory_gib);

/// @brief What will not fit or will waste the ranks, one sentence each, with what to change.
struct Advice {
  std::vector<std::string> must{};    ///< Without it the run will fail.
  std::vector<std::string> should{};  ///< Without it the run will be slow.
};

[[nodiscard]] Advice advise(const Prediction& prediction, const Resources& resources);

}  // namespace tessera::pipeline
