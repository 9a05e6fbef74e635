// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "tessera/coarse/options.hpp"
#include "tessera/cut/cut_tree.hpp"
#include "tessera/jobs/job_runner.hpp"

#include "pipeline/jobs/mesh_worker.hpp"
#include "pipeline/runtime/run_context.hpp"

namespace tessera::pipeline {

/// @brief What is tried.
struct CoarsePlan {
  coarse::CoarseOptions options{};
  cut::CutTree planes{};  ///< Without nodes: the model is not cut.
};

/// @brief How a try at the coarse mesh has ended.
struct CoarseAttempt {
  jobs::JobOutcome outcome{};       ///< Of its last job, or of the first one that failed.
  std::optional<CoarseTry> made{};  ///< On rank 0, if all went well.
};

/// @brief One try at the coarse mesh: the surface as a job of rank 0, its domains as jobs of all
/// ranks, and the whole as a job of rank 0.
///
/// Every job is a pure function of the model, the options and what the jobs before gave. Of several
/// domains that fail the first one counts. So the result does not depend on the number of ranks.
/// @note Collective. @throws Interrupted on a signal, on every rank.
[[nodiscard]] CoarseAttempt try_coarse_mesh(const CoarsePlan& plan, const jobs::JobLimits& limits,
                                            StageScope& stage, RunContext& context);

}  // namespace tessera::pipeline
