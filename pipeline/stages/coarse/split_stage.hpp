// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tessera/config/case.hpp"
#include "tessera/mesh/coarse_mesh.hpp"

#include "pipeline/runtime/run_context.hpp"

namespace tessera::pipeline {

/// @brief The coarse mesh such that it can be opened by `[[split]]` and `[[geometry.contact]]`.
/// @note Collective: a job of rank 0 if something is to be done. @throws on every rank as
/// topology::divide_at_rims().
[[nodiscard]] mesh::CoarseMesh run_rim_stage(const config::Case& run_case, mesh::CoarseMesh coarse,
                                             RunContext& context);

/// @brief The coarse mesh, open along the patches of `[[split]]`.
/// @note Collective. @throws on every rank as topology::split_patches().
[[nodiscard]] mesh::CoarseMesh run_split_stage(const config::Case& run_case,
                                               const mesh::CoarseMesh& closed, RunContext& context);

}  // namespace tessera::pipeline
