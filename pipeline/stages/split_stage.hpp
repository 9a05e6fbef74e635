// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pipeline/run_result.hpp"
#include "pipeline/runtime/run_context.hpp"

namespace tessera::pipeline {

/// @brief Makes the coarse mesh such that it can be opened by `[[split]]` and
/// `[[geometry.contact]]`; does nothing if the case has none. Sets `run.coarse.mesh`.
/// @note Collective: a job of rank 0 if something is to be done. @throws on every rank as
/// topology::divide_at_rims().
void divide_at_rims(RunResult& run, RunContext& context);

/// @brief Opens the coarse mesh along the patches of `[[split]]`; does nothing if the case has
/// none. Sets `run.coarse.mesh` and `run.levels`.
/// @note Collective. @throws on every rank as topology::split_patches().
void split_patches(RunResult& run, RunContext& context);

}  // namespace tessera::pipeline
