// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pipeline/run_result.hpp"
#include "pipeline/runtime/run_context.hpp"

namespace tessera::pipeline {

/// @brief Makes the sides of `[[periodic]]` images of each other; does nothing if the case has
/// none. Sets `run.coarse.mesh`.
/// @note Collective. @throws on every rank as topology::join_periodic_sides().
void join_periodic_sides(RunResult& run, RunContext& context);

}  // namespace tessera::pipeline
