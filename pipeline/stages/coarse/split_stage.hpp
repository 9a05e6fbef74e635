// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tessera/config/case.hpp"
#include "tessera/mesh/coarse_mesh.hpp"
#include "tessera/topology/options.hpp"

#include "pipeline/runtime/run_context.hpp"

namespace tessera::pipeline {

/// @brief All along which a case opens the mesh: `[[split]]`, `[[geometry.contact]]`, and between
/// two solids for `[[layer]]`. Local.
[[nodiscard]] topology::SplitOptions openings_of(const config::Case& run_case);

/// @brief The coarse mesh such that it can be opened by `[[split]]` and `[[geometry.contact]]`.
/// What joints cannot open stays closed.
/// @note Collective: a job of rank 0 if something is to be done. @throws on every rank as
/// topology::divide_at_rims().
[[nodiscard]] mesh::CoarseMesh run_rim_stage(const config::Case& run_case, mesh::CoarseMesh coarse,
                                             RunContext& context);

/// @brief The coarse mesh, opened.
/// @note Collective. @throws on every rank as topology::split_patches().
[[nodiscard]] mesh::CoarseMesh run_split_stage(const config::Case& run_case,
                                               const mesh::CoarseMesh& closed, RunContext& context);

}  // namespace tessera::pipeline
