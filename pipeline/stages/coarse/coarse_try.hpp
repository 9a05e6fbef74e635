// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <tuple>

#include "tessera/base/repair.hpp"
#include "tessera/cut/cut_tree.hpp"
#include "tessera/jobs/job_runner.hpp"
#include "tessera/surface/coarse_surface.hpp"
#include "tessera/surface/options.hpp"

#include "pipeline/jobs/mesh_worker.hpp"
#include "pipeline/runtime/run_context.hpp"

namespace tessera::pipeline {

/// @brief What is tried.
struct CoarsePlan {
  surface::CoarseOptions options{};
  cut::CutTree planes{};     ///< Without nodes: the model is not cut.
  LocalIndex rung = 0;       ///< Number of the try, from 0.
  jobs::JobLimits limits{};  ///< Of the surface.
};

/// @brief How the surface of a try has ended.
struct SurfaceTry {
  jobs::JobEnd end{};
  std::optional<surface::CoarseSurface> surface{};
  RepairCounts repairs{};  ///< In the surface.
};

/// @brief The first step of a try: the surface, in a job of this rank. A pure function of the model
/// and the options. Local. @throws Interrupted if it was cancelled.
[[nodiscard]] SurfaceTry try_coarse_surface(const CoarsePlan& plan,
                                            const jobs::JobRunner::WaitCallback& on_wait,
                                            RunContext& context);

/// @brief How a try at the coarse mesh has ended.
struct CoarseAttempt {
  jobs::JobEnd end{};               ///< Of its last job, or of the first one that failed.
  std::optional<CoarseTry> made{};  ///< On rank 0, if all went well.
  RepairCounts repairs{};           ///< On rank 0, of all these jobs.
};

/// @brief The other steps: the domains of the surface as jobs of all ranks, and the whole as a job
/// of rank 0.
///
/// Every job is a pure function of the model, the options and what the jobs before gave. Of several
/// domains that fail the first one counts. So the result does not depend on the number of ranks.
/// @param surface The same on every rank.
/// @note Collective. @throws Interrupted on a signal, on every rank.
[[nodiscard]] CoarseAttempt fill_coarse_surface(const CoarsePlan& plan,
                                                surface::CoarseSurface surface, StageScope& stage,
                                                RunContext& context);

}  // namespace tessera::pipeline
