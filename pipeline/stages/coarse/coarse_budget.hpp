// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tessera/base/types.hpp"
#include "tessera/coarse/model_figures.hpp"
#include "tessera/jobs/job_runner.hpp"
#include "tessera/surface/coarse_surface.hpp"
#include "tessera/surface/options.hpp"

/// Limits of the jobs of a try at the coarse mesh: at least ten times what they take, by what there
/// is to mesh. CoarseOptions::timeout_s takes their place if it is not 0.
namespace tessera::pipeline {

/// @brief Of the surface. @param is_first Whether it is the try as asked: it gets more time.
[[nodiscard]] jobs::JobLimits surface_limits(const surface::CoarseOptions& options,
                                             const coarse::ModelFigures& model, bool is_first);

/// @brief Of one domain, or a piece of it.
[[nodiscard]] jobs::JobLimits domain_limits(const surface::CoarseOptions& options,
                                            const surface::DomainSkin& skin);

/// @brief Of dividing a surface, and of putting the whole together.
[[nodiscard]] jobs::JobLimits whole_limits(const surface::CoarseOptions& options, double num_tets);

}  // namespace tessera::pipeline
