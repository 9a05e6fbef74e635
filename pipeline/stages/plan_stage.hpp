// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tessera/config/case.hpp"
#include "tessera/mesh/coarse_mesh.hpp"
#include "tessera/mesh/damping.hpp"
#include "tessera/mesh/decomposition.hpp"
#include "tessera/mesh/skeleton.hpp"

#include "pipeline/run_context.hpp"

namespace tessera::pipeline {

/// @brief Loads the mesh into all workers, finds the points whose projection would fold a skin, and
/// loads the plan that keeps them back.
///
/// In synchronous rounds: every subdomain is tested under the dampings so far, all findings are put
/// together, and those that touch a finding are tested again. Factors only fall, in few steps, so
/// it ends; rounds depend on subdomains only, so the plan is the same for every number of ranks.
/// @note Collective.
[[nodiscard]] mesh::Damping run_plan_stage(const config::Case& run_case,
                                           const mesh::CoarseMesh& coarse,
                                           const mesh::Decomposition& decomposition,
                                           const mesh::Skeleton& skeleton, RunContext& context);

}  // namespace tessera::pipeline
