// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pipeline/run_result.hpp"
#include "pipeline/runtime/run_context.hpp"

namespace tessera::pipeline {

/// @brief Makes room for layers in the coarse mesh; does nothing if the case has none. Sets
/// `run.coarse.mesh` and `run.cover`.
/// @note Collective: a job of rank 0. @throws ConfigError on every rank as layers::grow_layers();
/// MeshError if the job fails.
void grow_layers(RunResult& run, RunContext& context);

}  // namespace tessera::pipeline
